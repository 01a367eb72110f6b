// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <opencv2/core/mat.hpp>
#include <optional>
#include <string>

#include "base/options.h"
#include "camera/intrinsics.h"
#include "localize/skyline_matcher.h"
#include "projection/scene.h"
#include "score/skyline_l1.h"
#include "skyline/canny_skyline.h"
#include "skyline/skyline_extractor.h"

namespace ridgeline {

struct SkylineTrackOptions {
  // "path": ours; "canny": the paper's.
  std::string extractor = "path";
  // Where a frame's match begins: "sensors", or "last": the sensors turned by what the last good
  // match corrected (the paper's outlook), which a compass needs once rather than at every frame.
  std::string start = "sensors";
  SkylineOptions skyline;
  CannySkylineOptions canny;
  SkylineL1Options l1;
  SkylineMatchOptions match;

  SkylineTrackOptions();
  void Visit(OptionVisitor& v);
  // Throws InputError naming the field, e.g. "start".
  void Validate() const;
};

// Milliseconds of one frame.
struct SkylineFrameTimes {
  double extract_ms = 0.0;
  double clean_ms = 0.0;
  double match_ms = 0.0;

  double Total() const { return extract_ms + clean_ms + match_ms; }
};

struct SkylineFrame {
  Skyline skyline;  // as extracted, in pixels of the picture
  Pose start;       // cam_from_local
  SkylineMatchResult match;
  SkylineFrameTimes times;
};

// Poses of the frames of a sequence, each corrected by its skyline. Keeps what it learned from the
// last frame; not thread-safe.
class SkylineTracker {
 public:
  // The scene must outlive the tracker. Throws InputError for options that cannot be used.
  SkylineTracker(const Scene& scene, const SkylineTrackOptions& options);

  // @param sensors  The pose by the sensors, cam_from_local.
  // @param bgr  CV_8UC3, without distortion.
  SkylineFrame Track(const cv::Mat& bgr, const PinholeCamera& camera, const Pose& sensors);

 private:
  const Scene& scene_;
  const SkylineTrackOptions options_;
  // What the last good match added to the sensors' angles [deg].
  std::optional<ViewAngles> correction_;
};

}  // namespace ridgeline
