// SPDX-License-Identifier: Apache-2.0
#include "optim/random_strategy.h"

#include "base/random.h"

namespace ridgeline {

std::optional<UnitPoint> RandomStrategy::Propose(std::int64_t) {
  static const std::uint64_t kStage = HashText("optim.random");
  Random random(context_.seed, kStage, draws_++);
  UnitPoint point(context_.dimension);
  for (double& u : point) u = random.Uniform();
  return point;
}

}  // namespace ridgeline
