// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <limits>
#include <memory>

#include "base/options.h"
#include "optim/gp_strategy.h"
#include "optim/population.h"
#include "optim/strategy.h"

namespace ridgeline {

// Gaussian process first, then differential evolution, with the options of both.
struct GpDeOptions {
  // Trials of the Gaussian process, >= 1.
  int gp_trials = 200;

  void Visit(OptionVisitor& v);
};

// A Gaussian process for the first trials, which finds more with few than any other sampler here
// but costs time that grows with their number; then differential evolution, from fresh Sobol points
// and the best point so far, which finds what the process has missed.
class GpDe final : public Strategy {
 public:
  GpDe(const StrategyContext& context,
       const GpOptions& gp,
       const DifferentialEvolutionOptions& de,
       const GpDeOptions& options);

  std::optional<UnitPoint> Propose(std::int64_t id) override;
  void Reject(std::int64_t id) override;
  void Observe(std::int64_t id, const UnitPoint& point, double energy, TrialState state) override;

 private:
  StrategyContext context_;
  DifferentialEvolutionOptions de_options_;
  int gp_trials_ = 0;
  GpStrategy gp_;
  // Null while the Gaussian process proposes.
  std::unique_ptr<Strategy> de_;
  std::int64_t last_id_ = -1;
  UnitPoint best_;
  double least_ = std::numeric_limits<double>::infinity();
};

}  // namespace ridgeline
