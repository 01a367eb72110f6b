// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

#include "camera/intrinsics.h"
#include "lines/line_segment.h"

namespace ridgeline {

// Signed angle [rad], in [-pi / 2, pi / 2], at the middle of a line from the image of lines of a
// direction (camera axes) to it; the line has no direction of its own. 0 if the middle is the
// vanishing point itself.
double AngleToDirection(const LineSegment& segment,
                        const PinholeCamera& camera,
                        const Eigen::Vector3d& direction_in_camera);

}  // namespace ridgeline
