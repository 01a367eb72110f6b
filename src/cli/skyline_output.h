// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <memory>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <string>
#include <vector>

#include "camera/pose.h"
#include "track/skyline_tracker.h"

namespace ridgeline {

// What became of one frame.
struct SkylineFrameResult {
  std::string id;
  std::string status;  // ok, missing_picture, missing_sensors, or NameOf(SkylineMatchStatus)
  std::string reason;
  std::string method;  // as match.method; a key frame's is 6dof. Empty: not matched
  std::optional<SkylineDistances> by_sensors;
  std::optional<SkylineDistances> at_best;
  std::optional<SkylineDistances> at_truth;  // what trees, details and the extraction leave
  std::optional<double> heading_sigma_deg;
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
  SkylineDistances by_sensors;
  SkylineDistances at_best;
  SkylineFrameTimes times;         // over all frames with a picture
  std::size_t with_truth = 0;      // of the matched
  double start_heading_deg = 0.0;  // mean errors of the start and of the result, absolute
  double heading_deg = 0.0;
  double tilt_deg = 0.0;      // larger of pitch and roll
  SkylineDistances at_truth;  // means over those with a truth
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
