// SPDX-License-Identifier: Apache-2.0
#include "track/visual_odometry.h"

#include <algorithm>
#include <cmath>

namespace ridgeline {
namespace {

// Deviations of a length, as a share of it, by where the speed is from.
constexpr double kByWheels = 0.05;
constexpr double kByTrack = 0.25;
constexpr double kByPrior = 0.6;

}  // namespace

VisualOdometry::Result VisualOdometry::Next(const cv::Mat& bgr,
                                            const PinholeCamera& camera,
                                            double seconds,
                                            const std::optional<double>& wheels_m_s) {
  const VisualMotion::Result seen = pictures_.Next(bgr, camera);
  Result result;
  result.missing = seen.missing;
  result.is_cut = seen.is_cut;
  result.zoom = seen.zoom;
  if (!seen.motion) return result;
  Motion motion = *seen.motion;
  const double speed = wheels_m_s.value_or(learned_m_s_.value_or(usual_m_s_));
  const double length_m = std::abs(speed) * seconds;
  motion.scale_sigma = wheels_m_s ? kByWheels : learned_m_s_ ? kByTrack : kByPrior;
  motion.length = wheels_m_s     ? StepLength::kMeasured
                  : learned_m_s_ ? StepLength::kFollowed
                                 : StepLength::kGuessed;
  motion.sigma_m = std::max(0.05, motion.sigma_m * length_m);
  motion.step_in_before *= length_m;  // the pictures see whether it is backward
  if (seen.is_standing) motion.scale_sigma = 0.0;
  result.motion = motion;
  return result;
}

}  // namespace ridgeline
