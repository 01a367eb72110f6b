// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cmath>

#include "camera/pose.h"

namespace ridgeline {

// East, north, height [m, local frame], heading, pitch, roll [deg]: the parameters that a filter
// has beliefs about. Meant for cameras that do not look straight up or down.
using PoseVector = Eigen::Matrix<double, 6, 1>;
using PoseCovariance = Eigen::Matrix<double, 6, 6>;

inline Pose PoseOf(const PoseVector& v) {
  return {CamFromWorld(ViewAngles{WrapHeadingDeg(v(3)), v(4), v(5)}), v.head<3>()};
}

inline PoseVector VectorOf(const Pose& pose) {
  const ViewAngles angles = ViewAnglesOf(pose.cam_from_world);
  PoseVector v;
  v << pose.center_in_world, angles.heading_deg, angles.pitch_deg, angles.roll_deg;
  return v;
}

// a - b; angles the short way round.
inline PoseVector DifferenceOf(const PoseVector& a, const PoseVector& b) {
  PoseVector d = a - b;
  d(3) = HeadingDifferenceDeg(a(3), b(3));
  d(5) = HeadingDifferenceDeg(a(5), b(5));
  return d;
}

// Whether two poses would be called one answer.
inline bool IsNear(const PoseVector& a, const PoseVector& b, double within_m, double within_deg) {
  const PoseVector d = DifferenceOf(a, b);
  return d.head<3>().squaredNorm() <= within_m * within_m && std::abs(d(3)) <= within_deg;
}

}  // namespace ridgeline
