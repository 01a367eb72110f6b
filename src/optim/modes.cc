// SPDX-License-Identifier: Apache-2.0
#include "optim/modes.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"

namespace ridgeline {
namespace {

bool Neighbours(const SearchBox& box,
                const std::vector<double>& separation,
                const std::vector<double>& a,
                const std::vector<double>& b) {
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (std::abs(box.Difference(i, a[i], b[i])) > separation[i]) return false;
  }
  return true;
}

}  // namespace

void DistinctModesOptions::Validate(const SearchBox& box) const {
  if (separation.size() != box.Size()) {
    throw InputError("",
                     "modes.separation",
                     std::to_string(separation.size()) + " values",
                     std::to_string(box.Size()) + " values, one per parameter");
  }
  for (std::size_t i = 0; i < separation.size(); ++i) {
    if (separation[i] >= 0.0) continue;
    throw InputError(
        "", "modes.separation: " + box.parameters[i].name, std::to_string(separation[i]), ">= 0");
  }
  if (max_modes <= 0) throw InputError("", "modes.max_modes", std::to_string(max_modes), "> 0");
}

std::vector<Mode> DistinctModes(const Trace& trace,
                                const SearchBox& box,
                                const DistinctModesOptions& options) {
  options.Validate(box);
  std::vector<const Trial*> ranked;
  for (const Trial& trial : trace.trials) {
    if (trial.state == TrialState::kComplete) ranked.push_back(&trial);
  }
  std::stable_sort(ranked.begin(), ranked.end(), [](const Trial* a, const Trial* b) {
    return a->energy < b->energy;
  });
  std::vector<Mode> modes;
  for (auto it = ranked.begin(); it != ranked.end(); ++it) {
    if (static_cast<int>(modes.size()) == options.max_modes) break;
    const bool best_around = std::none_of(ranked.begin(), it, [&](const Trial* better) {
      return Neighbours(box, options.separation, better->values, (*it)->values);
    });
    if (best_around) modes.push_back({(*it)->index, (*it)->values, (*it)->energy});
  }
  return modes;
}

}  // namespace ridgeline
