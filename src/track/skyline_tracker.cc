// SPDX-License-Identifier: Apache-2.0
#include "track/skyline_tracker.h"

#include <algorithm>
#include <chrono>

#include "track/rendered_skyline.h"

namespace ridgeline {
namespace {

// How well the position of the last good frame holds for the next one [m].
constexpr double kCarriedPositionSigmaM = 1.5;

using Clock = std::chrono::steady_clock;

double MillisecondsSince(Clock::time_point start) {
  return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

}  // namespace

SkylineTrackOptions::SkylineTrackOptions() {
  // Frames of a video are small and many: half the resolution costs a quarter of the time and, with
  // rows sharpened on the frame itself, little accuracy.
  skyline.work_width_px = 320;
  skyline.sky.work_width_px = 160;
}

void SkylineTrackOptions::Visit(OptionVisitor& v) {
  v.Field("extractor", extractor, OneOf{{"path", "canny", "file"}});
  v.Field("virtual_skyline", virtual_skyline, OneOf{{"exact", "rendered"}});
  v.Field("start", start, OneOf{{"sensors", "last"}});
  v.Field("keyframe_every", keyframe_every, NotNegative());
  v.Group("skyline", [&](OptionVisitor& g) { skyline.Visit(g); });
  v.Group("canny", [&](OptionVisitor& g) { canny.Visit(g); });
  v.Group("l1", [&](OptionVisitor& g) { l1.Visit(g); });
  v.Group("match", [&](OptionVisitor& g) { match.Visit(g); });
}

SkylineTracker::SkylineTracker(const Scene& scene, const SkylineTrackOptions& options)
    : scene_(scene), options_(options) {
  CheckOptions(options_);
}

Pose SkylineTracker::Apply(const Correction& correction, const Pose& sensors) {
  ViewAngles angles = ViewAnglesOf(sensors.cam_from_world);
  angles.heading_deg += correction.angles.heading_deg;
  angles.pitch_deg += correction.angles.pitch_deg;
  angles.roll_deg += correction.angles.roll_deg;
  return {CamFromWorld(angles), sensors.center_in_world + correction.shift};
}

SkylineTracker::Correction SkylineTracker::Between(const Pose& sensors, const Pose& found) {
  const ViewAngles a = ViewAnglesOf(sensors.cam_from_world);
  const ViewAngles b = ViewAnglesOf(found.cam_from_world);
  return {{HeadingDifferenceDeg(b.heading_deg, a.heading_deg),
           b.pitch_deg - a.pitch_deg,
           HeadingDifferenceDeg(b.roll_deg, a.roll_deg)},
          found.center_in_world - sensors.center_in_world};
}

SkylineFrame SkylineTracker::Track(const cv::Mat& bgr,
                                   const PinholeCamera& camera,
                                   const Pose& sensors,
                                   const Skyline* given) {
  SkylineFrame frame;
  const Clock::time_point begin = Clock::now();
  if (given != nullptr) {
    frame.skyline = *given;
  } else {
    frame.skyline = options_.extractor == "canny" ? ExtractCannySkyline(bgr, options_.canny)
                                                  : ExtractSkyline(bgr, options_.skyline);
  }
  frame.times.extract_ms = MillisecondsSince(begin);

  const Clock::time_point extracted = Clock::now();
  const SkylineL1 l1(frame.skyline, camera, options_.l1);
  frame.times.clean_ms = MillisecondsSince(extracted);

  const Clock::time_point cleaned = Clock::now();
  const bool from_last = options_.start == "last";
  const bool keys = from_last && options_.keyframe_every > 0;
  frame.start = from_last && correction_ ? Apply(*correction_, sensors) : sensors;
  frame.method = SkylineMatchNamed(options_.match.method);
  if (!keys || (correction_ && frames_since_key_ < options_.keyframe_every)) {
    SkylineMatchOptions match = options_.match;
    // The last frame's position, not the sensors'.
    if (keys) match.position_sigma_m = kCarriedPositionSigmaM;
    frame.match = MatchSkyline(l1, Source(camera), frame.start, match);
    ++frames_since_key_;
  }
  // A frame that three angles cannot match is a key frame too.
  if (keys && !frame.match.pose) {
    SkylineMatchOptions match = options_.match;
    match.method = "6dof";
    frame.method = SkylineMatch::k6dof;
    frame.match = MatchSkyline(l1, Source(camera), frame.start, match);
    frames_since_key_ = 1;
  }
  frame.times.match_ms = MillisecondsSince(cleaned);

  correction_.reset();
  if (frame.match.pose) correction_ = Between(sensors, *frame.match.pose);
  frame.by_sensors = DistancesAt(frame.skyline, camera, sensors);
  frame.at_best = DistancesAt(frame.skyline, camera, frame.match.best);
  return frame;
}

SkylineSource SkylineTracker::Source(const PinholeCamera& camera) const {
  if (options_.virtual_skyline == "rendered") {
    const double px_per_rad =
        camera.fx * std::min(1.0, static_cast<double>(options_.canny.work_width_px) / camera.width);
    return [this, px_per_rad](const Eigen::Vector3d& position, const Sector& sector) {
      return RenderedSkyline(scene_, position, sector, px_per_rad, options_.canny);
    };
  }
  return [this](const Eigen::Vector3d& position, const Sector& sector) {
    return SkylineDirections(scene_.SkylineFrom(position, sector));
  };
}

SkylineDistances SkylineTracker::DistancesAt(const Skyline& skyline,
                                             const PinholeCamera& camera,
                                             const Pose& cam_from_local) const {
  SkylineL1Options plain = options_.l1;
  plain.robust = false;
  const auto at_pose = [&](const SkylineL1Options& l1) {
    return DistanceAt(SkylineL1(skyline, camera, l1), Source(camera), cam_from_local, options_.match);
  };
  return {at_pose(options_.l1), at_pose(plain)};
}

}  // namespace ridgeline
