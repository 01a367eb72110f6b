// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "localize/localization.h"
#include "localize/pose_scorer.h"

namespace ridgeline {

struct ExploreOptions {
  // Spacing of positions [m]; that of Ayadi et al.
  double spacing_m = 0.5;
  // Spacing of the headings looked at first [deg].
  double heading_step_deg = 1.0;
  // Half-ranges of pitch and roll where the box has them fixed [deg].
  double tilt_deg = 3.0;
};

// The score at every position of the box with the best heading, pitch and roll there. Row-major
// from south to north; NaN: not admissible.
struct ExploredMap {
  EnergyMap map;  // energy 1 where nothing is in view
  std::vector<float> pitch_deg;
  std::vector<float> roll_deg;
};

// Exhaustive exploration of Ayadi et al., section 6.2 and its Fig. 9. At each position all headings
// of the box are tried, and from the best ones heading, pitch and roll are improved together until
// steps of 1/8 degree gain nothing. Parallel over positions.
ExploredMap Explore(const PoseScorer& scorer, const ExploreOptions& options, int threads);

}  // namespace ridgeline
