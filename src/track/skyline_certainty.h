// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <functional>
#include <vector>

#include "camera/pose.h"
#include "score/skyline_l1.h"

namespace ridgeline {

// How well a pose is known before its skyline is looked at.
struct SkylinePrior {
  double heading_sigma_deg = 10.0;
  double tilt_sigma_deg = 1.0;
  double position_sigma_m = 6.0;  // east and north
  // Whether the match moved the position too. If not, the heading has made up for its error.
  bool position_matched = false;
};

// Standard deviation of the heading of a matched pose [deg]: what the distances of the columns
// leave open, together with the other angles and the position (the height is taken as known). A
// corner near by does not tell a turn from a step aside.
//
// @param look  Virtual skyline seen from a position (local frame), as unit vectors by azimuth.
// @param distance_px  Distance at the pose [px at 640]: what the columns are off by.
double HeadingSigmaDeg(
    const SkylineL1& real,
    const std::function<std::vector<Eigen::Vector3f>(const Eigen::Vector3d&)>& look,
    const Pose& pose,
    double distance_px,
    const SkylinePrior& prior);

}  // namespace ridgeline
