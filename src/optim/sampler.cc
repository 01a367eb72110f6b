// SPDX-License-Identifier: Apache-2.0
#include "optim/sampler.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "base/error.h"
#include "optim/sampler_table.h"

namespace ridgeline {
namespace {

// A box without free parameters has one point.
class OnePoint final : public Strategy {
 public:
  std::optional<UnitPoint> Propose(std::int64_t) override {
    if (proposed_) return std::nullopt;
    proposed_ = true;
    return UnitPoint{};
  }
  void Reject(std::int64_t) override { throw NoFeasiblePoint(1); }
  void Observe(std::int64_t, const UnitPoint&, double, TrialState) override {}
  bool Ended() const override { return proposed_; }

  static InputError NoFeasiblePoint(int draws) {
    return {"",
            "search",
            "no admissible point in " + std::to_string(draws) + " draws",
            "a box that holds admissible points"};
  }

 private:
  bool proposed_ = false;
};

// Proposes the user's first guess, then leaves the word to another strategy.
class StartFirst final : public Strategy {
 public:
  StartFirst(UnitPoint start, std::unique_ptr<Strategy> rest)
      : start_(std::move(start)), rest_(std::move(rest)) {}

  std::optional<UnitPoint> Propose(std::int64_t id) override {
    if (start_id_ >= 0) return rest_->Propose(id);
    start_id_ = id;
    at_start_ = true;
    return start_;
  }
  void Reject(std::int64_t id) override {
    if (!at_start_) rest_->Reject(id);
    at_start_ = false;
  }
  void Observe(std::int64_t id, const UnitPoint& point, double energy, TrialState state) override {
    rest_->Observe(id, point, energy, state);
  }
  bool Ended() const override { return start_id_ >= 0 && rest_->Ended(); }

 private:
  UnitPoint start_;
  std::unique_ptr<Strategy> rest_;
  std::int64_t start_id_ = -1;
  bool at_start_ = false;
};

std::string Text(const std::vector<double>& values) {
  std::ostringstream text;
  text.precision(17);
  for (std::size_t i = 0; i < values.size(); ++i) text << (i > 0 ? ", " : "(") << values[i];
  text << (values.empty() ? "()" : ")");
  return text.str();
}

std::string Place(const Trial& trial, const char* field) {
  return (trial.index == kOwnTrial ? "own trial" : "trial " + std::to_string(trial.index)) + ": " +
         field;
}

void ValidateResult(const Trial& trial) {
  const bool fits = (trial.state == TrialState::kComplete && std::isfinite(trial.energy)) ||
                    (trial.state == TrialState::kInfeasible && std::isinf(trial.energy)) ||
                    (trial.state == TrialState::kFailed && std::isnan(trial.energy));
  if (fits) return;
  throw InputError("",
                   Place(trial, "energy"),
                   std::to_string(trial.energy) + " with another state",
                   "energy and state as Trial::SetEnergy() sets them");
}

}  // namespace

Sampler::Sampler(const SearchProblem& problem, std::unique_ptr<Strategy> strategy)
    : problem_(problem), cube_(problem.box), strategy_(std::move(strategy)) {}

bool Sampler::Admissible(const std::vector<double>& values) const {
  return !problem_.feasible || problem_.feasible(values);
}

std::optional<Sampler::Outstanding> Sampler::NextAdmissible() {
  for (int draw = 0; draw < kMaxRejections; ++draw) {
    const std::optional<UnitPoint> point = strategy_->Propose(next_index_);
    if (!point) return std::nullopt;
    const std::vector<double> values = cube_.ToBox(*point);
    if (Admissible(values)) return Outstanding{*point, values};
    strategy_->Reject(next_index_);
  }
  throw OnePoint::NoFeasiblePoint(kMaxRejections);
}

std::vector<Trial> Sampler::Ask(int count) {
  std::vector<Trial> trials;
  while (static_cast<int>(trials.size()) < count) {
    const std::optional<Outstanding> next = NextAdmissible();
    if (!next) break;
    outstanding_.emplace(next_index_, *next);
    Trial trial;
    trial.index = next_index_++;
    trial.values = next->values;
    trials.push_back(trial);
  }
  return trials;
}

void Sampler::Tell(const Trial& trial) {
  ValidateResult(trial);
  if (!problem_.box.Contains(trial.values)) {
    throw InputError("", Place(trial, "values"), Text(trial.values), "a point of the box");
  }
  if (trial.index == kOwnTrial) {
    strategy_->Observe(next_index_++, cube_.ToUnit(trial.values), trial.energy, trial.state);
    return;
  }
  const auto it = outstanding_.find(trial.index);
  if (it == outstanding_.end()) {
    throw InputError("",
                     Place(trial, "index"),
                     trial.index < next_index_ ? "a trial told before" : "a trial not asked for",
                     "the index of a trial from Ask()");
  }
  if (it->second.values != trial.values) {
    throw InputError("", Place(trial, "values"), Text(trial.values), Text(it->second.values));
  }
  const UnitPoint point = it->second.point;
  outstanding_.erase(it);
  strategy_->Observe(trial.index, point, trial.energy, trial.state);
}

bool Sampler::Ended() const { return strategy_->Ended(); }

std::unique_ptr<Sampler> MakeSampler(const SamplerOptions& options,
                                     const SearchProblem& problem,
                                     std::uint64_t seed) {
  CheckOptions(options, "sampler");
  problem.box.Validate();
  if (!problem.start.empty() && !problem.box.Contains(problem.start)) {
    throw InputError("", "search.start", Text(problem.start), "a point of the box");
  }
  const UnitCube cube(problem.box);
  if (cube.dimension() == 0) {
    return std::make_unique<Sampler>(problem, std::make_unique<OnePoint>());
  }
  StrategyContext context;
  context.dimension = cube.dimension();
  context.periodic = cube.periodic();
  context.names = cube.names();
  for (const Parameter& parameter : problem.box.parameters) {
    context.parameters.push_back(parameter.name);
  }
  context.seed = seed;
  if (!problem.start.empty()) context.start = cube.ToUnit(problem.start);

  const SamplerPlugin& plugin = FindSampler(options.name);
  std::unique_ptr<Strategy> strategy = plugin.make(context, options.groups);
  if (!context.start.empty() && !plugin.begins_at_start) {
    strategy = std::make_unique<StartFirst>(context.start, std::move(strategy));
  }
  return std::make_unique<Sampler>(problem, std::move(strategy));
}

}  // namespace ridgeline
