// SPDX-License-Identifier: Apache-2.0
#include "localize/skyline_tracker.h"

#include <chrono>

#include "base/error.h"

namespace ridgeline {
namespace {

using Clock = std::chrono::steady_clock;

double MillisecondsSince(Clock::time_point start) {
  return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

Pose Corrected(const Pose& sensors, const ViewAngles& correction) {
  ViewAngles angles = ViewAnglesOf(sensors.cam_from_world);
  angles.heading_deg += correction.heading_deg;
  angles.pitch_deg += correction.pitch_deg;
  angles.roll_deg += correction.roll_deg;
  return {CamFromWorld(angles), sensors.center_in_world};
}

ViewAngles CorrectionFrom(const Pose& sensors, const Pose& found) {
  const ViewAngles a = ViewAnglesOf(sensors.cam_from_world);
  const ViewAngles b = ViewAnglesOf(found.cam_from_world);
  return {HeadingDifferenceDeg(b.heading_deg, a.heading_deg),
          b.pitch_deg - a.pitch_deg,
          HeadingDifferenceDeg(b.roll_deg, a.roll_deg)};
}

}  // namespace

SkylineTrackOptions::SkylineTrackOptions() {
  // Frames of a video are small and many: half the resolution costs a quarter of the time and, with
  // rows sharpened on the frame itself, little accuracy.
  skyline.work_width_px = 320;
  skyline.sky.work_width_px = 160;
}

void SkylineTrackOptions::Visit(OptionVisitor& v) {
  v.Field("extractor", extractor);
  v.Field("start", start);
  v.Group("skyline", [&](OptionVisitor& g) { skyline.Visit(g); });
  v.Group("canny", [&](OptionVisitor& g) { canny.Visit(g); });
  v.Group("l1", [&](OptionVisitor& g) { l1.Visit(g); });
  v.Group("match", [&](OptionVisitor& g) { match.Visit(g); });
}

void SkylineTrackOptions::Validate() const {
  if (extractor != "path" && extractor != "canny") {
    throw InputError("", "extractor", '"' + extractor + '"', "path or canny");
  }
  if (start != "sensors" && start != "last") {
    throw InputError("", "start", '"' + start + '"', "sensors or last");
  }
  skyline.Validate();
  canny.Validate();
  l1.Validate();
  match.Validate();
}

SkylineTracker::SkylineTracker(const Scene& scene, const SkylineTrackOptions& options)
    : scene_(scene), options_(options) {
  options_.Validate();
}

SkylineFrame SkylineTracker::Track(const cv::Mat& bgr,
                                   const PinholeCamera& camera,
                                   const Pose& sensors) {
  SkylineFrame frame;
  const Clock::time_point begin = Clock::now();
  frame.skyline = options_.extractor == "canny" ? ExtractCannySkyline(bgr, options_.canny)
                                                : ExtractSkyline(bgr, options_.skyline);
  frame.times.extract_ms = MillisecondsSince(begin);

  const Clock::time_point extracted = Clock::now();
  const SkylineL1 l1(frame.skyline, camera, options_.l1);
  frame.times.clean_ms = MillisecondsSince(extracted);

  const Clock::time_point cleaned = Clock::now();
  const bool from_last = options_.start == "last" && correction_.has_value();
  frame.start = from_last ? Corrected(sensors, *correction_) : sensors;
  const auto source = [this](const Eigen::Vector3d& position, const Sector& sector) {
    return SkylineDirections(scene_.SkylineFrom(position, sector));
  };
  frame.match = MatchSkyline(l1, source, frame.start, options_.match);
  frame.times.match_ms = MillisecondsSince(cleaned);
  if (frame.match.pose) {
    correction_ = CorrectionFrom(sensors, *frame.match.pose);
  } else {
    correction_.reset();
  }
  return frame;
}

}  // namespace ridgeline
