// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "base/options.h"
#include "optim/parzen.h"
#include "optim/strategy.h"

namespace ridgeline {

// Tree-structured Parzen estimator; the defaults are those of Optuna 3.1.
struct TpeOptions {
  // Uniform random trials before the densities are used, >= 1.
  int startup_trials = 10;
  // Draws from the density of the good trials, of which the best ratio is proposed, >= 1.
  int candidates = 24;
  // The good trials are the best min(ceil(good_fraction * n), good_max), at least one.
  double good_fraction = 0.1;
  int good_max = 25;
  // Weight of the prior kernel beside 1 per trial, > 0.
  double prior_weight = 1.0;
  // Lower limit of bandwidths: range / min(100, 1 + number of kernels).
  bool magic_clip = true;
  // Univariate rule: outermost kernels reach to the bounds.
  bool consider_endpoints = false;
  // Kernels are divided by their deviation, as in Optuna since 3.5. Undivided, as in 3.1, the
  // search does better on smooth functions and as well on recorded landscapes, see
  // docs/samplers.md.
  bool divide_by_deviation = false;

  void Visit(OptionVisitor& v);
};

enum class TpeModel {
  // One density per parameter, each searched by itself: "TPE" in Optuna and hyperopt, and what
  // Loeper et al. 3.1.4 use.
  kUnivariate,
  // One density over all parameters (Falkner et al. 2018): finds correlated parameters.
  kMultivariate,
};

// Tree-structured Parzen estimator (Bergstra et al. 2011): proposes the point, among draws from the
// density l of the good trials, where l is largest relative to the density g of the others.
//
// The rules are those of Optuna 3.1.0 (TPESampler): startup, number of good trials, chronological
// weights with a ramp, bandwidths (neighbour gaps; Scott's rule if multivariate), magic clip, prior
// kernel, constant liar, and constraints (infeasible results rank behind all others). By option,
// kernels are divided by their deviation as in Optuna since 3.5 (its issue 5109). Ours are: the
// wrap-around kernel of periodic parameters; points that are known to be inadmissible are drawn
// again, after kPatience of them uniformly. Failed trials are forgotten, as in Optuna.
class TpeStrategy final : public Strategy {
 public:
  TpeStrategy(const StrategyContext& context, const TpeOptions& options, TpeModel model);

  std::optional<UnitPoint> Propose(std::int64_t id) override;
  void Reject(std::int64_t id) override;
  void Observe(std::int64_t id, const UnitPoint& point, double energy, TrialState state) override;

  static constexpr int kPatience = 100;

 private:
  struct Entry {
    std::int64_t id = 0;
    double energy = 0.0;
    TrialState state = TrialState::kAsked;
    bool good = false;
    double weight = 1.0;
  };

  // Densities of the good trials and of the others, over one parameter or over all.
  struct DensityPair {
    ParzenEstimator good;
    ParzenEstimator other;
  };

  void Commit();
  void BuildModel();
  void Split();
  DensityPair MakePair(const std::vector<std::size_t>& order,
                       const std::vector<std::size_t>& dimensions) const;
  UnitPoint DrawUniform(Random& random) const;
  UnitPoint DrawFromModel(Random& random) const;
  void Insert(const Entry& entry, const UnitPoint& point);
  void Remove(std::size_t index);

  StrategyContext context_;
  TpeOptions options_;
  TpeModel model_;
  // In the order of ids, with the coordinates beside them, and per dimension the indices by value.
  std::vector<Entry> entries_;
  Columns columns_;
  std::vector<std::vector<std::size_t>> by_value_;
  int finished_ = 0;
  // Of the present entries; empty if they have changed. Redraws of a rejected point share it.
  std::vector<DensityPair> pairs_;
  // The last proposal becomes an entry when it is known to be admissible.
  std::int64_t last_id_ = -1;
  UnitPoint last_point_;
  int rejections_ = 0;
  std::uint64_t draws_ = 0;
};

// Optuna's weights of n trials, oldest first: a ramp from 1/n up to 1, and 1 for the last 25.
std::vector<double> TpeWeights(std::size_t n);

}  // namespace ridgeline
