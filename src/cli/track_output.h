// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "camera/intrinsics.h"
#include "city/city_model.h"
#include "track/track_errors.h"
#include "track/track_files.h"

namespace ridgeline {

// What is told of a whole track.
struct TrackSummary {
  std::size_t frames = 0;
  std::size_t tracking = 0;
  std::size_t relocalizing = 0;
  std::size_t lost = 0;
  TrackErrors causal;
  TrackErrors smoothed;
  // Of frames with truth that were reported with confidence 0.9 or more.
  std::size_t confident = 0;
  std::size_t confident_wrong = 0;  // off by more than 5 m
  // While tracking: shares of the frames whose truth is within the protection level, and within the
  // 95 % ellipse.
  std::size_t protectable = 0;
  double protected_share = 0.0;
  double ellipse_share = 0.0;
  // Time of a frame, all and while tracking [ms]; the mean gives the frames a second.
  double median_ms = 0.0;
  double p95_ms = 0.0;
  double tracking_mean_ms = 0.0;
  std::optional<GnssMonitor::Verdict> gnss;  // the last
  std::optional<std::string> gnss_noticed_at;  // frame
};
TrackSummary SummaryOf(std::span<const TrackRow> rows);

// summary.json: the summary, what was found out about the odometry, and where the start was from.
std::string SummaryJson(const TrackSummary& summary,
                        const std::vector<std::string>& notes,
                        const std::string& start_from);

// frames.csv, poses.tum, and of the smoothed poses smoothed.tum, colmap/, track.geojson, track.kml
// (WGS 84; where the model's system is known), into an existing folder.
void WriteTrackFiles(std::span<const TrackRow> rows,
                     std::span<const std::optional<CameraIntrinsics>> cameras,
                     const CityModel& model,
                     const std::filesystem::path& folder);

// One frame as a line of JSON with a line feed.
std::string TrackJsonLine(const TrackFrame& frame, const Crs& crs);

// One frame as NMEA sentences. `before`: the last frame with a pose, for speed and course; may be
// null.
std::string TrackNmea(const TrackFrame& frame, const TrackFrame* before, const Crs& crs);

}  // namespace ridgeline
