// SPDX-License-Identifier: Apache-2.0
#include "optim/trial.h"

#include <cmath>

namespace ridgeline {

void Trial::SetEnergy(double value) {
  energy = value;
  if (std::isfinite(value)) {
    state = TrialState::kComplete;
  } else if (value > 0.0) {
    state = TrialState::kInfeasible;
  } else {
    state = TrialState::kFailed;
    energy = std::numeric_limits<double>::quiet_NaN();
    message = "the energy is " + std::to_string(value);
  }
}

}  // namespace ridgeline
