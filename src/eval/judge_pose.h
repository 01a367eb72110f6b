// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <limits>
#include <string>

#include "localize/localizer.h"

namespace ridgeline {

// What our score says of a pose that another system found.
struct PoseJudgement {
  double energy = std::numeric_limits<double>::quiet_NaN();  // NaN: it cannot be judged
  Goodness goodness;
  std::string reason;  // why it cannot be judged, in words
};

// The energy of one pose (world frame), as a search would see it there, without a prior's say.
// @param input  Picture and camera; its prior is not looked at.
// Throws InputError for a picture whose size is not the camera's.
PoseJudgement JudgePose(const Localizer& localizer,
                        const LocalizationInput& input,
                        const Pose& pose,
                        int threads);

}  // namespace ridgeline
