// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "augment/textured_mesh.h"
#include "camera/intrinsics.h"
#include "camera/pose.h"
#include "projection/scene.h"

namespace ridgeline {

// What an insertion does to the sky of a picture, by the model's own sky (the new construction's
// influence on the skyline, Ayadi et al., section 1).
struct SkyImpact {
  double sky_before = 0.0;  // share of the picture
  double sky_lost = 0.0;    // share of the sky before
  double raised_columns = 0.0;  // share of the columns
  double mean_rise_px = 0.0;    // over the raised columns
  double highest_rise_px = 0.0;
  std::vector<int> before;  // by column: first row that is not sky; the height: none
  std::vector<int> after;
};

// @param coverage  Insertion::coverage of the same view.
SkyImpact ImpactOf(const Scene& city,
                   const PinholeCamera& camera,
                   const Pose& cam_from_local,
                   const cv::Mat& coverage);

// "x_px,y_before_px,y_after_px" by column.
std::string ImpactCsv(const SkyImpact& impact);

// What stands before a planned building in a photo though the city model lacks it; an approximation:
// leaves, and whatever covers the sky where the model has sky (trees, lamps, people, cars). Such
// things behind the building are taken to be before it, too. CV_8U, 255: foreground.
cv::Mat AutomaticForeground(const cv::Mat& photo,
                            const Scene& city,
                            const PinholeCamera& camera,
                            const Pose& cam_from_local);

// A pose and the truth of one frame; absent: not known.
struct InsertedFrame {
  PinholeCamera camera;
  std::optional<Pose> pose;   // cam_from_local
  std::optional<Pose> truth;
};

// How true and how steady an inserted building stands in a film.
struct InsertionStability {
  int frames = 0;            // with pose and truth, and the building before the camera in both
  double mean_error_px = 0.0;  // of the building's box corners
  double worst_error_px = 0.0;
  // Root mean square of the error's change from one frame to the next: what is seen as hovering.
  int steps = 0;
  double jitter_px = 0.0;
};
InsertionStability StabilityOf(std::span<const InsertedFrame> frames, const TexturedMesh& mesh);

}  // namespace ridgeline
