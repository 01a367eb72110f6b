// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

#include "base/options.h"
#include "optim/gaussian_process.h"
#include "optim/sobol.h"
#include "optim/strategy.h"

namespace ridgeline {

// Gaussian-process Bayesian optimization.
struct GpOptions {
  // Sobol points before the model is used, >= 2.
  int startup_trials = 10;
  // Trials the model holds at most, >= 20: the better half are the best ones, the rest the latest.
  int max_points = 500;
  // The hyper-parameters are estimated anew when the number of trials has grown by this fraction.
  double refit_growth = 0.1;
  // Points that the expected improvement is looked at before its best ones are climbed from.
  int candidates = 192;
  int climbs = 4;

  void Visit(OptionVisitor& v);
};

// Bayesian optimization: a Gaussian process is fitted to the results, and the point of greatest
// expected improvement is proposed (Jones et al. 1998), as its logarithm (Ament et al. 2023), found
// by climbing from the best of many candidates.
//
// Hyper-parameters maximise the marginal likelihood times a weak prior, from the last ones and from
// the middle of the prior. Points that are outstanding count with their predicted mean ("kriging
// believer", Ginsbourger et al. 2010). Infeasible results count as the worst one seen, failed ones
// not at all. If a proposal is not admissible the next best candidate follows, then uniform points.
class GpStrategy final : public Strategy {
 public:
  GpStrategy(const StrategyContext& context, const GpOptions& options);

  std::optional<UnitPoint> Propose(std::int64_t id) override;
  void Reject(std::int64_t id) override;
  void Observe(std::int64_t id, const UnitPoint& point, double energy, TrialState state) override;

 private:
  struct Entry {
    std::int64_t id = 0;
    UnitPoint point;
    double energy = 0.0;
    TrialState state = TrialState::kAsked;
  };

  void UpdateModel();
  void FitHyper(const Eigen::MatrixXd& points, const Eigen::VectorXd& targets);
  std::vector<const Entry*> Finished() const;
  Eigen::VectorXd Targets(const std::vector<const Entry*>& entries) const;
  std::vector<UnitPoint> RankCandidates();
  Eigen::MatrixXd Candidates();

  StrategyContext context_;
  GpOptions options_;
  SobolSequence startup_;
  std::vector<Entry> entries_;

  GpHyper hyper_;
  std::size_t fitted_size_ = 0;
  GaussianProcess process_;
  // The entries in process_, in its order; the outstanding ones are the last.
  std::vector<std::int64_t> modelled_;
  double best_target_ = 0.0;

  std::int64_t last_id_ = -1;
  UnitPoint last_point_;
  std::vector<UnitPoint> ranked_;
  std::size_t next_ranked_ = 0;
  std::uint64_t draws_ = 0;
};

}  // namespace ridgeline
