// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "optim/strategy.h"

namespace ridgeline {

// Uniform independent points. Proposal k is a function of seed and k, whatever was told before.
class RandomStrategy final : public Strategy {
 public:
  explicit RandomStrategy(const StrategyContext& context) : context_(context) {}

  std::optional<UnitPoint> Propose(std::int64_t id) override;
  void Reject(std::int64_t) override {}
  void Observe(std::int64_t, const UnitPoint&, double, TrialState) override {}

 private:
  StrategyContext context_;
  std::uint64_t draws_ = 0;
};

}  // namespace ridgeline
