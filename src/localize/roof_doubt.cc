// SPDX-License-Identifier: Apache-2.0
#include "localize/roof_doubt.h"

#include <cmath>

namespace ridgeline {

std::vector<RoofShift> RoofsInDoubt(const Goodness& goodness) {
  constexpr double kLeastM = 0.5;
  constexpr double kLeastGain = 3.0;
  std::vector<RoofShift> roofs;
  for (const BuildingFit& fit : goodness.buildings) {
    if (std::abs(fit.roof_shift_m) >= kLeastM && fit.roof_gain >= kLeastGain) {
      roofs.push_back({fit.building, fit.roof_shift_m});
    }
  }
  return roofs;
}

}  // namespace ridgeline
