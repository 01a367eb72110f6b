// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <cstdint>

#include "camera/pose.h"

namespace ridgeline {

// Where the length of a step is from: measured, in one scale for all steps; from the speed that was
// followed so far; or from nothing but a usual speed.
enum class StepLength : std::uint8_t { kMeasured, kFollowed, kGuessed };

// How a camera has moved from one frame to a later one, and how well that is known.
struct Motion {
  Eigen::Quaterniond now_from_before = Eigen::Quaterniond::Identity();  // camera axes
  Eigen::Vector3d step_in_before = Eigen::Vector3d::Zero();  // of the projection centre [m]
  // Standard deviations, the same in all axes.
  double sigma_m = 0.0;
  double sigma_deg = 0.0;
  // Of the length of the step, as a share of it: one error for all steps.
  double scale_sigma = 0.0;
  StepLength length = StepLength::kMeasured;
};

// The first motion, then the second.
Motion Composed(const Motion& first, const Motion& second);

// Where a pose is after the motion.
Pose Moved(const Pose& before, const Motion& motion);

// The motion between two poses; its deviations are left at 0.
Motion MotionBetween(const Pose& before, const Pose& now);

// A camera that may have gone any way at up to `speed_m_s` for a time, and turned at `turn_deg_s`.
Motion UnknownMotion(double seconds, double speed_m_s, double turn_deg_s);

}  // namespace ridgeline
