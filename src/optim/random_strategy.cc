// SPDX-License-Identifier: Apache-2.0
#include "optim/random_strategy.h"

#include <memory>

#include "base/random.h"
#include "optim/sampler_plugin.h"

namespace ridgeline {

std::optional<UnitPoint> RandomStrategy::Propose(std::int64_t) {
  static const std::uint64_t kStage = HashText("optim.random");
  Random random(context_.seed, kStage, draws_++);
  UnitPoint point(context_.dimension);
  for (double& u : point) u = random.Uniform();
  return point;
}

extern const SamplerPlugin kRandomSampler;
constinit const SamplerPlugin kRandomSampler = {
    .name = "random",
    .declare = [](OptionGroups&) {},
    .make = [](const StrategyContext& context, const OptionGroups& /*options*/)
        -> std::unique_ptr<Strategy> { return std::make_unique<RandomStrategy>(context); }};

}  // namespace ridgeline
