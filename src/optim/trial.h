// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

namespace ridgeline {

// What became of a point.
enum class TrialState {
  kAsked,       // proposed, not told yet
  kComplete,    // has a finite energy
  kInfeasible,  // the evaluation found the point not admissible (energy +infinity)
  kFailed,      // the evaluation threw, or gave NaN or -infinity; teaches a sampler nothing good
};

// Index of a trial that no sampler proposed, for Sampler::Tell().
inline constexpr std::int64_t kOwnTrial = -1;

// One evaluation of a search.
struct Trial {
  // Running number of the proposal, from 0, without gaps.
  std::int64_t index = kOwnTrial;
  // One value per parameter of the box, fixed ones included, in the box's order and units.
  std::vector<double> values;
  // To be minimised. Finite if and only if the state is kComplete.
  double energy = std::numeric_limits<double>::quiet_NaN();
  TrialState state = TrialState::kAsked;
  // Why it failed; else empty.
  std::string message;

  // Sets energy and state by the value of a score: finite is kComplete, +infinity is kInfeasible,
  // anything else is kFailed.
  void SetEnergy(double value);
};

}  // namespace ridgeline
