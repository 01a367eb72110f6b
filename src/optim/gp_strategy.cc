// SPDX-License-Identifier: Apache-2.0
#include "optim/gp_strategy.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <numeric>

#include "optim/batch_search.h"
#include "optim/box_bfgs.h"
#include "optim/expected_improvement.h"
#include "optim/gp_likelihood.h"
#include "optim/sampler_plugin.h"

namespace ridgeline {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

// Bounds, centres and deviations of the hyper-parameters (natural logarithms): lengths of 0.01 to
// 10 ranges, about 0.4; variances of the standardised energies.
struct HyperPrior {
  double lower = 0.0;
  double upper = 0.0;
  double center = 0.0;
  double deviation = 1.0;
};
const HyperPrior kLength = {-4.6, 2.3, -0.9, 1.0};
const HyperPrior kSignal = {-3.0, 3.0, 0.0, 1.0};
const HyperPrior kNoise = {-13.8, 0.0, -7.0, 2.0};

std::vector<HyperPrior> Priors(std::size_t dimension) {
  std::vector<HyperPrior> priors(dimension, kLength);
  priors.push_back(kSignal);
  priors.push_back(kNoise);
  return priors;
}

// Deviation of candidates around the best points, as fractions of the ranges.
constexpr double kNear[] = {0.1, 0.02, 0.004};
constexpr std::size_t kBestPoints = 4;

VectorXd ToVector(const UnitPoint& point) {
  return Eigen::Map<const VectorXd>(point.data(), static_cast<Index>(point.size()));
}

UnitPoint ToPoint(const VectorXd& x, const std::vector<bool>& periodic) {
  return FoldIntoCube(UnitPoint(x.data(), x.data() + x.size()), periodic);
}

}  // namespace

void GpOptions::Visit(OptionVisitor& v) {
  v.Field("startup_trials", startup_trials, AtLeast(2));
  v.Field("max_points", max_points, AtLeast(20));
  v.Field("refit_growth", refit_growth, NotNegative());
  v.Field("candidates", candidates, AtLeast(1));
  v.Field("climbs", climbs, NotNegative());
}

GpStrategy::GpStrategy(const StrategyContext& context, const GpOptions& options)
    : context_(context),
      options_(options),
      startup_(context.dimension, context.seed),
      process_(context.periodic) {
  const std::vector<HyperPrior> priors = Priors(context.dimension);
  hyper_.resize(static_cast<Index>(priors.size()));
  for (std::size_t i = 0; i < priors.size(); ++i) hyper_[i] = priors[i].center;
}

std::optional<UnitPoint> GpStrategy::Propose(std::int64_t id) {
  static const std::uint64_t kStage = HashText("optim.gp.uniform");
  if (id != last_id_) {
    if (!last_point_.empty()) entries_.push_back({last_id_, last_point_, 0.0, TrialState::kAsked});
    last_id_ = id;
    ranked_.clear();
    next_ranked_ = 0;
    if (static_cast<int>(Finished().size()) >= options_.startup_trials) {
      UpdateModel();
      ranked_ = RankCandidates();
    }
  }
  if (ranked_.empty()) {
    last_point_ = startup_.Next();
  } else if (next_ranked_ < ranked_.size()) {
    last_point_ = ranked_[next_ranked_++];
  } else {
    Random random(context_.seed, kStage, draws_++);
    last_point_ = UniformPoint(random, context_.dimension);
  }
  return last_point_;
}

void GpStrategy::Reject(std::int64_t) { last_point_.clear(); }

void GpStrategy::Observe(std::int64_t id, const UnitPoint& point, double energy, TrialState state) {
  if (!last_point_.empty()) entries_.push_back({last_id_, last_point_, 0.0, TrialState::kAsked});
  last_point_.clear();
  const auto it = std::find_if(
      entries_.begin(), entries_.end(), [&](const Entry& entry) { return entry.id == id; });
  if (it == entries_.end()) {
    if (state != TrialState::kFailed) entries_.push_back({id, point, energy, state});
  } else if (state == TrialState::kFailed) {
    entries_.erase(it);
  } else {
    it->energy = energy;
    it->state = state;
  }
}

// Entries with a result, at most max_points: the best half and the latest half, by age.
std::vector<const GpStrategy::Entry*> GpStrategy::Finished() const {
  std::vector<const Entry*> finished;
  for (const Entry& entry : entries_) {
    if (entry.state != TrialState::kAsked) finished.push_back(&entry);
  }
  const std::size_t most = static_cast<std::size_t>(options_.max_points);
  if (finished.size() <= most) return finished;
  const auto latest = finished.end() - static_cast<std::ptrdiff_t>(most / 2);
  const std::size_t best = most - most / 2;
  std::nth_element(finished.begin(),
                   finished.begin() + static_cast<std::ptrdiff_t>(best),
                   latest,
                   [](const Entry* a, const Entry* b) {
                     return a->energy != b->energy ? a->energy < b->energy : a->id < b->id;
                   });
  finished.erase(finished.begin() + static_cast<std::ptrdiff_t>(best), latest);
  std::sort(finished.begin(), finished.end(), [](const Entry* a, const Entry* b) {
    return a->id < b->id;
  });
  return finished;
}

// Energies with mean 0 and deviation 1; infeasible ones are the worst.
VectorXd GpStrategy::Targets(const std::vector<const Entry*>& entries) const {
  double worst = -std::numeric_limits<double>::infinity();
  for (const Entry* entry : entries) {
    if (entry->state == TrialState::kComplete) worst = std::max(worst, entry->energy);
  }
  VectorXd targets(static_cast<Index>(entries.size()));
  for (std::size_t i = 0; i < entries.size(); ++i) {
    const bool complete = entries[i]->state == TrialState::kComplete;
    targets[i] = complete ? entries[i]->energy : (std::isfinite(worst) ? worst : 0.0);
  }
  targets.array() -= targets.mean();
  const double deviation = std::sqrt(targets.squaredNorm() / static_cast<double>(targets.size()));
  // Differences in the last bits are not worth a model.
  if (deviation > 1e-12) targets /= deviation;
  return targets;
}

void GpStrategy::FitHyper(const MatrixXd& points, const VectorXd& targets) {
  const std::vector<HyperPrior> priors = Priors(context_.dimension);
  VectorXd lower(hyper_.size());
  VectorXd upper(hyper_.size());
  VectorXd center(hyper_.size());
  for (Index i = 0; i < hyper_.size(); ++i) {
    lower[i] = priors[i].lower;
    upper[i] = priors[i].upper;
    center[i] = priors[i].center;
  }
  const GpLikelihood log_likelihood(points, targets, context_.periodic);
  const SmoothFunction negative_log_posterior = [&](const VectorXd& hyper, VectorXd* gradient) {
    double value = -log_likelihood(hyper, gradient);
    *gradient *= -1.0;
    for (Index i = 0; i < hyper.size(); ++i) {
      const double away = (hyper[i] - priors[i].center) / priors[i].deviation;
      value += 0.5 * away * away;
      (*gradient)[i] += away / priors[i].deviation;
    }
    return value;
  };
  BoxBfgsOptions bfgs;
  const bool cheap = points.cols() < 100;
  // Few steps where each costs milliseconds: the start is the last optimum, and refits are many.
  bfgs.max_iterations = cheap ? 12 : 4;
  bfgs.tolerance = 1e-3;
  BoxBfgsResult result = MinimizeInBox(negative_log_posterior, hyper_, lower, upper, bfgs);
  if (fitted_size_ == 0 || cheap) {
    // The last optimum may be a poor one.
    const BoxBfgsResult fresh = MinimizeInBox(negative_log_posterior, center, lower, upper, bfgs);
    if (fresh.value < result.value) result = fresh;
  }
  if (std::isfinite(result.value)) hyper_ = result.x;
}

void GpStrategy::UpdateModel() {
  const std::vector<const Entry*> finished = Finished();
  const VectorXd targets = Targets(finished);
  best_target_ = targets.minCoeff();

  std::vector<std::int64_t> ids;
  for (const Entry* entry : finished) ids.push_back(entry->id);
  const double growth = 1.0 + options_.refit_growth;
  const bool refit = static_cast<double>(finished.size()) >= growth * fitted_size_;
  std::size_t shared = 0;
  while (shared < std::min(ids.size(), modelled_.size()) && ids[shared] == modelled_[shared]) {
    ++shared;
  }
  if (refit || shared < ids.size() / 2) {
    MatrixXd points(static_cast<Index>(context_.dimension), static_cast<Index>(finished.size()));
    for (std::size_t i = 0; i < finished.size(); ++i) {
      points.col(static_cast<Index>(i)) = ToVector(finished[i]->point);
    }
    if (refit) {
      FitHyper(points, targets);
      fitted_size_ = finished.size();
    }
    process_.Reset(points, hyper_);
  } else {
    process_.Shrink(shared);
    for (std::size_t i = shared; i < finished.size(); ++i) {
      process_.Append(ToVector(finished[i]->point));
    }
  }
  process_.SetTargets(targets);
  modelled_ = ids;

  std::vector<double> all(targets.data(), targets.data() + targets.size());
  for (const Entry& entry : entries_) {
    if (entry.state != TrialState::kAsked) continue;
    const VectorXd point = ToVector(entry.point);
    all.push_back(process_.Predict(point, nullptr, nullptr).mean);
    process_.Append(point);
    process_.SetTargets(Eigen::Map<const VectorXd>(all.data(), static_cast<Index>(all.size())));
    modelled_.push_back(entry.id);
  }
}

// Uniform points of the cube and points around the best ones.
MatrixXd GpStrategy::Candidates() {
  static const std::uint64_t kStage = HashText("optim.gp.candidates");
  Random random(context_.seed, kStage, draws_++);
  std::vector<const Entry*> best = Finished();
  const std::size_t count = std::min(kBestPoints, best.size());
  std::partial_sort(best.begin(),
                    best.begin() + static_cast<std::ptrdiff_t>(count),
                    best.end(),
                    [](const Entry* a, const Entry* b) {
                      return a->energy != b->energy ? a->energy < b->energy : a->id < b->id;
                    });
  MatrixXd candidates(static_cast<Index>(context_.dimension), options_.candidates);
  for (Index j = 0; j < candidates.cols(); ++j) {
    UnitPoint point = UniformPoint(random, context_.dimension);
    if (j % 2 == 1) {
      const std::size_t k = static_cast<std::size_t>(j / 2);
      const double deviation = kNear[k % std::size(kNear)];
      point = best[k / std::size(kNear) % count]->point;
      for (double& u : point) u += deviation * random.Normal();
      point = FoldIntoCube(point, context_.periodic);
    }
    candidates.col(j) = ToVector(point);
  }
  return candidates;
}

// Best first: the tops of the climbs, then the candidates.
std::vector<UnitPoint> GpStrategy::RankCandidates() {
  const MatrixXd candidates = Candidates();
  const std::vector<GaussianProcess::Prediction> predictions = process_.PredictAll(candidates);
  std::vector<double> improvements;
  for (const GaussianProcess::Prediction& p : predictions) {
    improvements.push_back(LogExpectedImprovement(best_target_, p.mean, p.deviation).value);
  }
  std::vector<Index> order(improvements.size());
  std::iota(order.begin(), order.end(), Index{0});
  std::stable_sort(order.begin(), order.end(), [&](Index a, Index b) {
    return improvements[a] > improvements[b];
  });

  const SmoothFunction negative = [&](const VectorXd& x, VectorXd* gradient) {
    VectorXd d_mean;
    VectorXd d_deviation;
    const GaussianProcess::Prediction p = process_.Predict(x, &d_mean, &d_deviation);
    const LogImprovement improvement = LogExpectedImprovement(best_target_, p.mean, p.deviation);
    *gradient = -(improvement.d_mean * d_mean + improvement.d_deviation * d_deviation);
    return -improvement.value;
  };
  // A climb may cross the seam of a periodic coordinate.
  VectorXd lower(static_cast<Index>(context_.dimension));
  VectorXd upper(static_cast<Index>(context_.dimension));
  for (std::size_t d = 0; d < context_.dimension; ++d) {
    lower[d] = context_.periodic[d] ? -0.5 : 0.0;
    upper[d] = context_.periodic[d] ? 1.5 : 1.0;
  }
  BoxBfgsOptions bfgs;
  bfgs.max_iterations = 15;
  bfgs.tolerance = 1e-4;
  std::vector<BoxBfgsResult> tops;
  const std::size_t climbs = std::min(order.size(), static_cast<std::size_t>(options_.climbs));
  for (std::size_t i = 0; i < climbs; ++i) {
    tops.push_back(MinimizeInBox(negative, candidates.col(order[i]), lower, upper, bfgs));
  }
  std::stable_sort(tops.begin(), tops.end(), [](const BoxBfgsResult& a, const BoxBfgsResult& b) {
    return a.value < b.value;
  });
  std::vector<UnitPoint> ranked;
  for (const BoxBfgsResult& top : tops) ranked.push_back(ToPoint(top.x, context_.periodic));
  for (const Index i : order) ranked.push_back(ToPoint(candidates.col(i), context_.periodic));
  return ranked;
}

extern const SamplerPlugin kGpSampler;
constinit const SamplerPlugin kGpSampler = {
    .name = "gp",
    .declare = [](OptionGroups& options) { options.Add<GpOptions>("gp"); },
    .make = [](const StrategyContext& context,
               const OptionGroups& options) -> std::unique_ptr<Strategy> {
      return std::make_unique<GpStrategy>(context, options.Get<GpOptions>());
    }};

}  // namespace ridgeline
