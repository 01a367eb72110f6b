// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "localize/gravity.h"
#include "localize/pose_scorer.h"

namespace ridgeline {

// What a picture scores where it cannot be from.
struct Background {
  std::vector<double> log_ratios;  // the highest over the orientations, by place
  std::uint64_t evaluations = 0;
};

// Looks from `count` places among the buildings of the model, outside of the scorer's box (fewer
// where the model or its terrain has no more), with the headings of the box from any direction on.
// The best of a box stands out of these where the picture was taken in it, and does not where it was
// not: then the box is one place among many.
Background BackgroundOf(const PoseScorer& scorer,
                        std::span<const Tilt> tilts,
                        double heading_step_deg,
                        int count,
                        int threads);

}  // namespace ridgeline
