// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

#include "camera/pose.h"
#include "camera/pose_prior.h"

namespace ridgeline {

// Half-ranges of the uniform error that a made prior has in each parameter.
struct Perturbation {
  double east_m = 0.0;
  double north_m = 0.0;
  double height_m = 0.0;
  double heading_deg = 0.0;
  double pitch_deg = 0.0;
  double roll_deg = 0.0;
};

// Parses "10,10,0,20" (east, north, height, heading) or six numbers (and pitch, roll). Throws
// InputError("--perturb", ...).
Perturbation ParsePerturbation(const std::string& text);

// A prior drawn uniformly around the truth; the numbers depend on (seed, query id) alone, so that
// adding a query changes no other.
PosePrior DrawPrior(const Pose& truth,
                    const Perturbation& half_ranges,
                    std::uint64_t seed,
                    const std::string& query_id);

}  // namespace ridgeline
