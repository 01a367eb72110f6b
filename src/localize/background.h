// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "localize/gravity.h"
#include "localize/pose_scorer.h"

namespace ridgeline {

// The best that a picture scores at a place where it cannot be from.
struct BackgroundPose {
  PoseSpace space;  // around the place
  ScoredPose best;  // an offset in `space`
};

// Looks from `count` places among the buildings of the model, outside of the scorer's box (fewer
// where the model or its terrain has no more), with the headings of the box from any direction on.
// The best of a box stands out of these where the picture was taken in it, and does not where it was
// not: then the box is one place among many. Best first; `evaluations` grows by the poses looked at.
std::vector<BackgroundPose> BackgroundOf(const PoseScorer& scorer,
                                         std::span<const Tilt> tilts,
                                         double heading_step_deg,
                                         int count,
                                         int threads,
                                         std::uint64_t& evaluations);

}  // namespace ridgeline
