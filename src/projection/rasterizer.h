// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <opencv2/core/mat.hpp>

#include "camera/intrinsics.h"
#include "camera/pose.h"
#include "city/city_model.h"

namespace ridgeline {

// Z-buffer of the model's triangles: depth [m along the optical axis] at the pixel centres, CV_32F;
// infinity where there is none. Triangles are clipped at 0.1 m; those all of whose corners are
// farther than `radius_m` east or north of the camera are left out (the box of Loeper et
// al., 3.1.1). The terrain is not part of it.
cv::Mat RasterizeDepth(const CityModel& model,
                       const PinholeCamera& camera,
                       const Pose& cam_from_local,
                       double radius_m);

}  // namespace ridgeline
