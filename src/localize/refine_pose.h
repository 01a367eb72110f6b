// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "localize/pose_scorer.h"

namespace ridgeline {

struct RefineSteps {
  double first_m = 0.5;
  double first_deg = 0.5;
  double last_m = 0.06;  // the search ends when the position's step is below this
};

struct RefinedPose {
  ScoredPose pose;
  std::uint64_t evaluations = 0;
};

// Climbs from a pose to the local maximum of the log likelihood ratio: a compass search over the
// free parameters of the position with exact visibility at every place, the free angles maximised
// at each (they cost no visibility). Steps are halved until the last. Stays within the box.
RefinedPose RefinePose(const PoseScorer& scorer, const ScoredPose& start, const RefineSteps& steps);

}  // namespace ridgeline
