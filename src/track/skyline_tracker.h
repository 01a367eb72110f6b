// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <opencv2/core/mat.hpp>
#include <optional>
#include <string>

#include "base/options.h"
#include "camera/intrinsics.h"
#include "projection/scene.h"
#include "score/skyline_l1.h"
#include "skyline/canny_skyline.h"
#include "skyline/skyline_extractor.h"
#include "track/skyline_matcher.h"

namespace ridgeline {

struct SkylineTrackOptions {
  // "path": ours; "canny": the paper's; "file": found by another program (skyline_file.h).
  std::string extractor = "path";
  // The model's skyline: "exact" from its edges, or "rendered": extracted from images of the model by
  // the paper's way (rendered_skyline.h), which is slow.
  std::string virtual_skyline = "exact";
  // Where a frame's match begins: "sensors", or "last": the sensors with what the last good match
  // corrected (the paper's outlook), since their errors drift slowly.
  std::string start = "last";
  // With start "last": the first of so many frames, and every frame that match.method cannot match,
  // is matched in all six degrees of freedom; 0: none.
  int keyframe_every = 5;
  SkylineOptions skyline;
  CannySkylineOptions canny;
  SkylineL1Options l1;
  SkylineMatchOptions match;

  SkylineTrackOptions();
  void Visit(OptionVisitor& v);
};

// Milliseconds of one frame.
struct SkylineFrameTimes {
  double extract_ms = 0.0;
  double clean_ms = 0.0;
  double match_ms = 0.0;

  double Total() const { return extract_ms + clean_ms + match_ms; }
};

// L1 distances between the skyline of a picture and the model's at a pose [px at 640].
struct SkylineDistances {
  double used_px = 0.0;   // as the options say
  double plain_px = 0.0;  // the paper's, plainly over all columns, trees and all
};

struct SkylineFrame {
  Skyline skyline;  // as extracted, in pixels of the picture
  Pose start;       // cam_from_local
  SkylineMatch method = SkylineMatch::k3d;
  SkylineDistances by_sensors;  // at the pose by the sensors
  SkylineDistances at_best;     // at the best pose found
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
  // @param given  The picture's skyline, for extractor "file".
  SkylineFrame Track(const cv::Mat& bgr,
                     const PinholeCamera& camera,
                     const Pose& sensors,
                     const Skyline* given = nullptr);

  // Distances of a skyline that was found in a picture of this camera, e.g. at the true pose.
  SkylineDistances DistancesAt(const Skyline& skyline,
                               const PinholeCamera& camera,
                               const Pose& cam_from_local) const;

 private:
  SkylineSource Source(const PinholeCamera& camera) const;

  const Scene& scene_;
  const SkylineTrackOptions options_;
  // What the last good match added to the sensors' pose.
  struct Correction {
    ViewAngles angles;
    Eigen::Vector3d shift = Eigen::Vector3d::Zero();
  };
  static Pose Apply(const Correction& correction, const Pose& sensors);
  static Correction Between(const Pose& sensors, const Pose& found);

  std::optional<Correction> correction_;
  int frames_since_key_ = 0;
};

}  // namespace ridgeline
