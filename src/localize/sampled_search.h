// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "localize/localizer_options.h"
#include "localize/pose_scorer.h"
#include "optim/trace.h"

namespace ridgeline {

struct SampledSearch {
  std::vector<ScoredPose> modes;  // distinct, best first
  Trace trace;                    // offsets from the prior: east_m, north_m, ... (SearchBoxOf)
};

// The space's offsets as a box: east_m, north_m, height_m, heading_deg, pitch_deg, roll_deg;
// heading is periodic if it is the whole circle.
SearchBox SearchBoxOf(const PoseSpace& space);

// Minimises the energy with the sampler of the options over the admissible poses of the space.
SampledSearch SampleSearch(const PoseScorer& scorer,
                           const SearchOptions& options,
                           std::uint64_t seed,
                           int threads);

}  // namespace ridgeline
