// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <vector>

#include "report/report_data.h"

namespace ridgeline {

// Closed outline of the 95 % ellipse of a position (chi-square with two degrees of freedom), 48
// sides.
std::vector<Eigen::Vector2d> EllipseOutline(const Eigen::Vector2d& center,
                                            const Eigen::Matrix2d& covariance);

// Closed outline of what a camera sees on the ground out to `reach_m`: a sector around its heading.
std::vector<Eigen::Vector2d> ViewCone(const ReportPose& pose, double hfov_deg, double reach_m);

}  // namespace ridgeline
