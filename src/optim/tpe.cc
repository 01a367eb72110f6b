// SPDX-License-Identifier: Apache-2.0
#include "optim/tpe.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <numeric>

#include "optim/sampler_plugin.h"

namespace ridgeline {
namespace {

constexpr std::size_t kFullWeights = 25;

bool Finished(TrialState state) {
  return state == TrialState::kComplete || state == TrialState::kInfeasible;
}

std::size_t BestRatio(const std::vector<double>& good, const std::vector<double>& other) {
  std::size_t best = 0;
  for (std::size_t i = 1; i < good.size(); ++i) {
    if (good[i] / other[i] > good[best] / other[best]) best = i;
  }
  return best;
}

}  // namespace

void TpeOptions::Visit(OptionVisitor& v) {
  v.Field("startup_trials", startup_trials, AtLeast(1));
  v.Field("candidates", candidates, AtLeast(1));
  v.Field("good_fraction", good_fraction, Open(0.0, 1.0));
  v.Field("good_max", good_max, AtLeast(1));
  v.Field("prior_weight", prior_weight, Open(0.0, 1e6));
  v.Field("magic_clip", magic_clip);
  v.Field("consider_endpoints", consider_endpoints);
  v.Field("divide_by_deviation", divide_by_deviation);
}

std::vector<double> TpeWeights(std::size_t n) {
  std::vector<double> weights(n, 1.0);
  if (n <= kFullWeights) return weights;
  const std::size_t ramp = n - kFullWeights;
  const double first = 1.0 / static_cast<double>(n);
  for (std::size_t i = 0; i < ramp; ++i) {
    const double along = ramp > 1 ? static_cast<double>(i) / static_cast<double>(ramp - 1) : 0.0;
    weights[i] = first + along * (1.0 - first);
  }
  return weights;
}

TpeStrategy::TpeStrategy(const StrategyContext& context, const TpeOptions& options, TpeModel model)
    : context_(context),
      options_(options),
      model_(model),
      columns_(context.dimension),
      by_value_(context.dimension) {}

std::optional<UnitPoint> TpeStrategy::Propose(std::int64_t id) {
  static const std::uint64_t kStage = HashText("optim.tpe");
  if (id != last_id_) {
    Commit();
    last_id_ = id;
    rejections_ = 0;
  }
  Random random(context_.seed, kStage, draws_++);
  if (finished_ < options_.startup_trials || rejections_ >= kPatience) {
    last_point_ = DrawUniform(random);
  } else {
    if (pairs_.empty()) BuildModel();
    last_point_ = DrawFromModel(random);
  }
  return last_point_;
}

void TpeStrategy::Reject(std::int64_t) {
  ++rejections_;
  last_point_.clear();
}

void TpeStrategy::Commit() {
  if (last_point_.empty()) return;
  Entry entry;
  entry.id = last_id_;
  entry.energy = std::numeric_limits<double>::infinity();
  Insert(entry, last_point_);
  last_point_.clear();
}

void TpeStrategy::Observe(std::int64_t id,
                          const UnitPoint& point,
                          double energy,
                          TrialState state) {
  Commit();
  const auto it = std::lower_bound(
      entries_.begin(), entries_.end(), id, [](const Entry& entry, std::int64_t i) {
        return entry.id < i;
      });
  const bool known = it != entries_.end() && it->id == id;
  if (known && !Finished(state)) Remove(it - entries_.begin());
  if (!Finished(state)) return;
  ++finished_;
  pairs_.clear();
  if (known) {
    it->energy = energy;
    it->state = state;
  } else {
    Insert({id, energy, state}, point);
  }
}

void TpeStrategy::Insert(const Entry& entry, const UnitPoint& point) {
  pairs_.clear();
  const auto it = std::upper_bound(
      entries_.begin(), entries_.end(), entry.id, [](std::int64_t i, const Entry& e) {
        return i < e.id;
      });
  const std::size_t index = it - entries_.begin();
  entries_.insert(it, entry);
  for (std::size_t d = 0; d < context_.dimension; ++d) {
    std::vector<double>& column = columns_[d];
    column.insert(column.begin() + index, point[d]);
    std::vector<std::size_t>& order = by_value_[d];
    if (index + 1 < entries_.size()) {
      for (std::size_t& i : order) i += i >= index ? 1 : 0;
    }
    const auto place =
        std::upper_bound(order.begin(), order.end(), point[d], [&](double x, std::size_t i) {
          return x < column[i];
        });
    order.insert(place, index);
  }
}

void TpeStrategy::Remove(std::size_t index) {
  pairs_.clear();
  for (std::size_t d = 0; d < context_.dimension; ++d) {
    std::vector<std::size_t>& order = by_value_[d];
    order.erase(std::find(order.begin(), order.end(), index));
    for (std::size_t& i : order) i -= i > index ? 1 : 0;
    columns_[d].erase(columns_[d].begin() + index);
  }
  entries_.erase(entries_.begin() + index);
}

// Marks the good trials and gives both groups their weights by age.
void TpeStrategy::Split() {
  const int good = std::clamp(static_cast<int>(std::ceil(options_.good_fraction * finished_)),
                              1,
                              std::min(options_.good_max, finished_));
  std::vector<std::size_t> order(entries_.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto rank = [this](std::size_t i) {
    // Results by energy, the infeasible (infinity) last; then what is outstanding (constant liar).
    return entries_[i].state == TrialState::kAsked ? 1 : 0;
  };
  const auto better = [&](std::size_t a, std::size_t b) {
    if (rank(a) != rank(b)) return rank(a) < rank(b);
    if (entries_[a].energy != entries_[b].energy) return entries_[a].energy < entries_[b].energy;
    return a < b;
  };
  std::nth_element(order.begin(), order.begin() + good - 1, order.end(), better);
  for (Entry& entry : entries_) entry.good = false;
  for (int i = 0; i < good; ++i) entries_[order[i]].good = true;

  const std::vector<double> good_weights = TpeWeights(good);
  const std::vector<double> other_weights = TpeWeights(entries_.size() - good);
  std::size_t next_good = 0;
  std::size_t next_other = 0;
  for (Entry& entry : entries_) {
    entry.weight = entry.good ? good_weights[next_good++] : other_weights[next_other++];
  }
}

void TpeStrategy::BuildModel() {
  Split();
  if (model_ == TpeModel::kMultivariate) {
    std::vector<std::size_t> all(context_.dimension);
    std::iota(all.begin(), all.end(), std::size_t{0});
    pairs_.push_back(MakePair(by_value_[0], all));
    return;
  }
  for (std::size_t d = 0; d < context_.dimension; ++d)
    pairs_.push_back(MakePair(by_value_[d], {d}));
}

TpeStrategy::DensityPair TpeStrategy::MakePair(const std::vector<std::size_t>& order,
                                               const std::vector<std::size_t>& dimensions) const {
  Columns points[2] = {Columns(dimensions.size()), Columns(dimensions.size())};
  std::vector<double> weights[2];
  for (std::vector<double>& group : weights) group.reserve(order.size());
  for (Columns& group : points) {
    for (std::vector<double>& column : group) column.reserve(order.size());
  }
  for (const std::size_t i : order) {
    const int group = entries_[i].good ? 0 : 1;
    for (std::size_t k = 0; k < dimensions.size(); ++k) {
      points[group][k].push_back(columns_[dimensions[k]][i]);
    }
    weights[group].push_back(entries_[i].weight);
  }
  std::vector<bool> periodic;
  for (const std::size_t d : dimensions) periodic.push_back(context_.periodic[d]);
  const ParzenOptions parzen = {
      model_ == TpeModel::kMultivariate ? BandwidthRule::kScott : BandwidthRule::kNeighbours,
      options_.prior_weight,
      options_.magic_clip,
      options_.consider_endpoints,
      options_.divide_by_deviation};
  return {ParzenEstimator(points[0], weights[0], periodic, parzen),
          ParzenEstimator(points[1], weights[1], periodic, parzen)};
}

UnitPoint TpeStrategy::DrawUniform(Random& random) const {
  UnitPoint point(context_.dimension);
  for (double& u : point) u = random.Uniform();
  return point;
}

UnitPoint TpeStrategy::DrawFromModel(Random& random) const {
  UnitPoint point;
  for (const DensityPair& pair : pairs_) {
    const Columns candidates = pair.good.Sample(random, options_.candidates);
    const std::size_t best =
        BestRatio(pair.good.Densities(candidates), pair.other.Densities(candidates));
    for (const std::vector<double>& column : candidates) point.push_back(column[best]);
  }
  return point;
}

extern const SamplerPlugin kTpeSampler;
constinit const SamplerPlugin kTpeSampler = {
    .name = "tpe",
    .declare = [](OptionGroups& options) { options.Add<TpeOptions>("tpe"); },
    .make = [](const StrategyContext& context,
               const OptionGroups& options) -> std::unique_ptr<Strategy> {
      return std::make_unique<TpeStrategy>(
          context, options.Get<TpeOptions>(), TpeModel::kUnivariate);
    }};

extern const SamplerPlugin kMultivariateTpeSampler;
constinit const SamplerPlugin kMultivariateTpeSampler = {
    .name = "tpe_multivariate",
    .declare = [](OptionGroups& options) { options.Add<TpeOptions>("tpe"); },
    .make = [](const StrategyContext& context,
               const OptionGroups& options) -> std::unique_ptr<Strategy> {
      return std::make_unique<TpeStrategy>(
          context, options.Get<TpeOptions>(), TpeModel::kMultivariate);
    }};

}  // namespace ridgeline
