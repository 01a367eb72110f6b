// SPDX-License-Identifier: Apache-2.0
#include "optim/gp_de.h"

#include <memory>

#include "base/random.h"
#include "optim/batch_search.h"
#include "optim/population.h"
#include "optim/sampler_plugin.h"

namespace ridgeline {

void GpDeOptions::Visit(OptionVisitor& v) { v.Field("gp_trials", gp_trials, AtLeast(1)); }

GpDe::GpDe(const StrategyContext& context,
           const GpOptions& gp,
           const DifferentialEvolutionOptions& de,
           const GpDeOptions& options)
    : context_(context), de_options_(de), gp_trials_(options.gp_trials), gp_(context, gp) {}

std::optional<UnitPoint> GpDe::Propose(std::int64_t id) {
  if (de_ == nullptr && id != last_id_ && gp_trials_-- == 0) {
    StrategyContext fresh = context_;
    fresh.start = best_;
    // Other Sobol points than those that began the Gaussian process.
    fresh.seed = MixBits(context_.seed);
    de_ = std::make_unique<BatchStrategy>(DifferentialEvolution(fresh, de_options_));
  }
  last_id_ = id;
  return de_ != nullptr ? de_->Propose(id) : gp_.Propose(id);
}

void GpDe::Reject(std::int64_t id) { de_ != nullptr ? de_->Reject(id) : gp_.Reject(id); }

void GpDe::Observe(std::int64_t id, const UnitPoint& point, double energy, TrialState state) {
  if (state == TrialState::kComplete && energy < least_) {
    least_ = energy;
    best_ = point;
  }
  de_ != nullptr ? de_->Observe(id, point, energy, state) : gp_.Observe(id, point, energy, state);
}

extern const SamplerPlugin kGpDeSampler;
constinit const SamplerPlugin kGpDeSampler = {
    .name = "gp_de",
    .declare =
        [](OptionGroups& options) {
          options.Add<GpOptions>("gp");
          options.Add<DifferentialEvolutionOptions>("de");
          options.Add<GpDeOptions>("gp_de");
        },
    .make = [](const StrategyContext& context,
               const OptionGroups& options) -> std::unique_ptr<Strategy> {
      return std::make_unique<GpDe>(context,
                                    options.Get<GpOptions>(),
                                    options.Get<DifferentialEvolutionOptions>(),
                                    options.Get<GpDeOptions>());
    }};

}  // namespace ridgeline
