// SPDX-License-Identifier: Apache-2.0
#include "eval/distinct_modes.h"

#include <algorithm>

#include "eval/metrics.h"

namespace ridgeline {

std::vector<PoseMode> DistinctModes(std::span<const PoseMode> modes) {
  constexpr double kSameM = 2.0;
  constexpr double kSameDeg = 2.0;
  std::vector<PoseMode> distinct;
  for (const PoseMode& mode : modes) {
    const bool is_same = std::any_of(distinct.begin(), distinct.end(), [&](const PoseMode& other) {
      const PoseError apart = ErrorOf(mode.pose, other.pose);
      return apart.translation_m <= kSameM && apart.rotation_deg <= kSameDeg;
    });
    if (!is_same) distinct.push_back(mode);
  }
  return distinct;
}

}  // namespace ridgeline
