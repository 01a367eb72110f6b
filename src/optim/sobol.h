// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "optim/strategy.h"

namespace ridgeline {

// Sobol sequence (direction numbers of Joe and Kuo 2008, from Boost), each coordinate scrambled
// by nested uniform scrambling (Owen 1995) with the hash of Burley 2020: any 2^k points from the
// start are spread evenly, and every seed is another such set. Up to 3667 dimensions.
class SobolSequence {
 public:
  SobolSequence(std::size_t dimension, std::uint64_t seed);
  ~SobolSequence();

  UnitPoint Next();

 private:
  struct Engine;
  std::unique_ptr<Engine> engine_;
  std::vector<std::uint32_t> seeds_;
};

class SobolStrategy final : public Strategy {
 public:
  explicit SobolStrategy(const StrategyContext& context)
      : sequence_(context.dimension, context.seed) {}

  std::optional<UnitPoint> Propose(std::int64_t) override { return sequence_.Next(); }
  void Reject(std::int64_t) override {}
  void Observe(std::int64_t, const UnitPoint&, double, TrialState) override {}

 private:
  SobolSequence sequence_;
};

}  // namespace ridgeline
