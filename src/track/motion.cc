// SPDX-License-Identifier: Apache-2.0
#include "track/motion.h"

#include <algorithm>
#include <cmath>

#include "base/angle.h"

namespace ridgeline {

Motion Composed(const Motion& first, const Motion& second) {
  Motion motion;
  motion.now_from_before = (second.now_from_before * first.now_from_before).normalized();
  motion.step_in_before =
      first.step_in_before + first.now_from_before.conjugate() * second.step_in_before;
  // A turn that is off puts the second step off to its side.
  const double aside_m = first.sigma_deg * kRadPerDeg * second.step_in_before.norm();
  motion.sigma_m = std::hypot(first.sigma_m, second.sigma_m, aside_m);
  motion.sigma_deg = std::hypot(first.sigma_deg, second.sigma_deg);
  motion.scale_sigma = std::max(first.scale_sigma, second.scale_sigma);
  return motion;
}

Pose Moved(const Pose& before, const Motion& motion) {
  return {(motion.now_from_before * before.cam_from_world).normalized(),
          before.center_in_world + before.cam_from_world.conjugate() * motion.step_in_before};
}

Motion MotionBetween(const Pose& before, const Pose& now) {
  Motion motion;
  motion.now_from_before = (now.cam_from_world * before.cam_from_world.conjugate()).normalized();
  motion.step_in_before = before.CameraFromWorld(now.center_in_world);
  return motion;
}

Motion UnknownMotion(double seconds, double speed_m_s, double turn_deg_s) {
  Motion motion;
  motion.sigma_m = 0.5 * speed_m_s * seconds;
  motion.sigma_deg = turn_deg_s * seconds;
  return motion;
}

}  // namespace ridgeline
