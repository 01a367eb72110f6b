// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <memory>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <string>
#include <vector>

#include "camera/pose.h"
#include "localize/skyline_tracker.h"

namespace ridgeline {

// What became of one frame.
struct SkylineFrameResult {
  std::string id;
  std::string status;  // ok, missing_picture, missing_sensors, or NameOf(SkylineMatchStatus)
  std::string reason;
  std::optional<double> before_px;  // L1 [px at 640]
  std::optional<double> after_px;
  std::optional<double> plain_before_px;  // the same over all columns, as in the paper
  std::optional<double> plain_after_px;
  std::optional<Pose> start;  // world
  std::optional<Pose> pose;   // world; absent unless ok
  std::optional<Pose> truth;  // world
  SkylineFrameTimes times;
};

// The frames as CSV: poses in the world frame, angles, errors against the truth, times.
std::string SkylineFramesCsv(const std::vector<SkylineFrameResult>& frames);

// Means over the frames that matched.
struct SkylineSummary {
  std::size_t frames = 0;
  std::size_t matched = 0;
  double before_px = 0.0;
  double after_px = 0.0;
  double plain_before_px = 0.0;
  double plain_after_px = 0.0;
  SkylineFrameTimes times;         // over all frames with a picture
  std::size_t with_truth = 0;      // of the matched
  double start_heading_deg = 0.0;  // mean errors of the start and of the result, absolute
  double heading_deg = 0.0;
  double tilt_deg = 0.0;  // larger of pitch and roll
};
SkylineSummary Summarize(const std::vector<SkylineFrameResult>& frames);

// The columns of a skyline as CSV: x_px, y_px, state, confidence.
std::string SkylineColumnsCsv(const Skyline& skyline);

// A video of pictures of one size, written when closed; MPEG-4 in .mp4.
class OverlayVideo {
 public:
  OverlayVideo(std::filesystem::path path, double frames_per_second);
  ~OverlayVideo();
  OverlayVideo(const OverlayVideo&) = delete;
  OverlayVideo& operator=(const OverlayVideo&) = delete;

  // Pictures are fitted to the size of the first one. Throws InputError if no encoder is there.
  void Add(const cv::Mat& bgr);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace ridgeline
