// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "camera/pose.h"

namespace ridgeline {

// Errors of a trajectory as the SLAM literature has them (Sturm et al., IROS 2012), without
// aligning it first: both are in the model's system.
struct TrackErrors {
  std::size_t frames = 0;  // with truth
  std::size_t posed = 0;   // and with a pose
  // Absolute: root of the mean square, median and largest [m], of positions in space; median and
  // largest of rotations [deg].
  double ate_rmse_m = 0.0;
  double ate_median_m = 0.0;
  double ate_max_m = 0.0;
  double rotation_median_deg = 0.0;
  double rotation_max_deg = 0.0;
  // Relative, from each frame with truth to the next: root of the mean square.
  double rpe_rmse_m = 0.0;
  double rpe_rmse_deg = 0.0;
  std::size_t steps = 0;
  // Shares of the frames with truth within 1, 3 and 5 m in space; frames without pose are outside.
  double within_1m = 0.0;
  double within_3m = 0.0;
  double within_5m = 0.0;
  double within_1m_1deg = 0.0;
  double within_5deg = 0.0;
};

// Both of the same frames, in order.
TrackErrors ErrorsOf(std::span<const std::optional<Pose>> poses,
                     std::span<const std::optional<Pose>> truths);

}  // namespace ridgeline
