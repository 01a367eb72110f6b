// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <limits>
#include <opencv2/core/mat.hpp>
#include <vector>

#include "base/options.h"
#include "camera/intrinsics.h"
#include "camera/pose.h"
#include "city/city_model.h"
#include "projection/scene.h"

namespace ridgeline {

// ProjectedSegment::piece of a segment that comes from no model edge.
inline constexpr std::uint32_t kNoPiece = 0xFFFFFFFFu;

struct ZbufferHoughOptions {
  // Half side of the box around the camera whose buildings count [m].
  double radius_m = 200.0;
  // Depth that is drawn as white [m]; 0 to it becomes 0 to 254, sky 255.
  double white_m = 200.0;
  // Canny: hysteresis thresholds on the gradient (L1) of the 8-bit depth.
  double canny_low = 10.0;
  double canny_high = 30.0;
  // Probabilistic Hough transform: cells [px, deg], votes, shortest segment and gap bridged [px].
  double rho_px = 1.0;
  double theta_deg = 0.5;
  int votes = 30;
  double min_length_px = 20.0;
  double max_gap_px = 4.0;

  void Visit(OptionVisitor& v) {
    v.Field("radius_m", radius_m, Positive());
    v.Field("white_m", white_m, Positive());
    v.Field("canny_low", canny_low, NotNegative());
    v.Field("canny_high", canny_high, AtLeast(canny_low, "canny_low"));
    v.Field("rho_px", rho_px, Positive());
    v.Field("theta_deg", theta_deg, LeftOpen(0.0, 90.0));
    v.Field("votes", votes, Positive());
    v.Field("min_length_px", min_length_px, NotNegative());
    v.Field("max_gap_px", max_gap_px, NotNegative());
  }
};

// Model lines as the paper finds them: the buildings' surfaces rasterized into a z-buffer, its
// edges by Canny, and segments in them by the probabilistic Hough transform. Segments [px] in the
// order of the transform, with the depth at their middle; no model edges (kNoPiece). Folds between
// faces that change the depth little are not found, as in the paper. Source: Loeper et al., 3.1.1.
// Cost: about that of Canny and Hough on the image size.
std::vector<ProjectedSegment> ZbufferHoughSegments(const CityModel& model,
                                                   const PinholeCamera& camera,
                                                   const Pose& cam_from_local,
                                                   const ZbufferHoughOptions& options);

}  // namespace ridgeline
