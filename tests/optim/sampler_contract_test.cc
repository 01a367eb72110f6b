// SPDX-License-Identifier: Apache-2.0
// What every sampler must do, whatever its method.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <set>
#include <stdexcept>

#include "base/error.h"
#include "optim/functions.h"
#include "optim/minimize.h"
#include "optim/sampler_table.h"

namespace ridgeline {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

class SamplerContract : public testing::TestWithParam<std::string> {
 protected:
  std::unique_ptr<Sampler> Make(const SearchProblem& problem, std::uint64_t seed = 1) const {
    SamplerOptions options;
    options.name = GetParam();
    return MakeSampler(options, problem, seed);
  }

  Trace Run(const SearchProblem& problem,
            const Energy& energy,
            int budget,
            int batch = 1,
            int threads = 1,
            std::uint64_t seed = 1) const {
    MinimizeOptions options;
    options.budget = budget;
    options.batch = batch;
    options.threads = threads;
    return Minimize(*Make(problem, seed), energy, options);
  }

  const SearchProblem pose_like_ = {PoseLikeBox(), {}, {}};
};

bool SameTrials(const Trace& a, const Trace& b) {
  if (a.trials.size() != b.trials.size()) return false;
  for (std::size_t i = 0; i < a.trials.size(); ++i) {
    if (a.trials[i].index != b.trials[i].index || a.trials[i].values != b.trials[i].values ||
        a.trials[i].state != b.trials[i].state) {
      return false;
    }
    if (a.trials[i].state == TrialState::kComplete && a.trials[i].energy != b.trials[i].energy) {
      return false;
    }
  }
  return true;
}

TEST_P(SamplerContract, StaysInTheBoxAndInTheBudget) {
  const Trace trace = Run(pose_like_, PoseLikeEnergy, 150, 4);
  ASSERT_EQ(trace.trials.size(), 150u);
  for (std::size_t i = 0; i < trace.trials.size(); ++i) {
    EXPECT_EQ(trace.trials[i].index, static_cast<std::int64_t>(i));
    EXPECT_TRUE(pose_like_.box.Contains(trace.trials[i].values));
    EXPECT_EQ(trace.trials[i].values[2], 1.7);
  }
}

TEST_P(SamplerContract, SameSeedSameTraceOtherSeedOtherTrace) {
  const Trace first = Run(pose_like_, PoseLikeEnergy, 120, 4, 1, 5);
  EXPECT_TRUE(SameTrials(first, Run(pose_like_, PoseLikeEnergy, 120, 4, 1, 5)));
  EXPECT_FALSE(SameTrials(first, Run(pose_like_, PoseLikeEnergy, 120, 4, 1, 6)));
}

TEST_P(SamplerContract, ThreadsDoNotChangeTheTrace) {
  EXPECT_TRUE(SameTrials(Run(pose_like_, PoseLikeEnergy, 120, 8, 1),
                         Run(pose_like_, PoseLikeEnergy, 120, 8, 8)));
}

TEST_P(SamplerContract, AskingForManyIsAskingManyTimesForOne) {
  const auto many = Make(pose_like_);
  const auto single = Make(pose_like_);
  for (int round = 0; round < 20; ++round) {
    std::vector<Trial> batch = many->Ask(5);
    for (Trial& trial : batch) {
      const std::vector<Trial> one = single->Ask(1);
      ASSERT_EQ(one.size(), 1u);
      EXPECT_EQ(one[0].values, trial.values);
    }
    for (Trial& trial : batch) {
      trial.SetEnergy(PoseLikeEnergy(trial.values));
      many->Tell(trial);
      single->Tell(trial);
    }
  }
}

TEST_P(SamplerContract, ResultsMayComeInAnyOrder) {
  const auto sampler = Make(pose_like_);
  for (int round = 0; round < 20; ++round) {
    std::vector<Trial> batch = sampler->Ask(6);
    ASSERT_FALSE(batch.empty());
    for (auto it = batch.rbegin(); it != batch.rend(); ++it) {
      it->SetEnergy(PoseLikeEnergy(it->values));
      sampler->Tell(*it);
    }
  }
}

TEST_P(SamplerContract, ContinuedTraceEqualsAnUninterruptedOne) {
  const Trace whole = Run(pose_like_, PoseLikeEnergy, 90, 8);
  for (const std::size_t stop : {1, 37, 90}) {
    Trace part = whole;
    part.trials.resize(stop);
    std::size_t evaluations = 0;
    MinimizeOptions options;
    options.budget = 90;
    options.batch = 8;
    const auto counting = [&](std::span<const double> v) {
      ++evaluations;
      return PoseLikeEnergy(v);
    };
    EXPECT_TRUE(SameTrials(whole, Minimize(*Make(pose_like_), counting, options, part)));
    EXPECT_EQ(evaluations, 90 - stop);
  }
}

TEST_P(SamplerContract, TraceOfAnotherSeedIsAnError) {
  const Trace other = Run(pose_like_, PoseLikeEnergy, 40, 8, 1, 2);
  MinimizeOptions options;
  options.batch = 8;
  EXPECT_THROW(Minimize(*Make(pose_like_), PoseLikeEnergy, options, other), InputError);
}

TEST_P(SamplerContract, InadmissiblePointsAreNeverEvaluated) {
  // Two strips, the optimum in neither: a tenth of the box.
  SearchProblem problem = pose_like_;
  problem.feasible = [](std::span<const double> v) {
    return std::abs(v[0] + 5.0) < 1.0 || std::abs(v[0] - 6.0) < 1.0;
  };
  const Trace trace = Run(problem, PoseLikeEnergy, 150, 4);
  EXPECT_EQ(trace.trials.size(), 150u);
  for (const Trial& trial : trace.trials) EXPECT_TRUE(problem.feasible(trial.values));
}

TEST_P(SamplerContract, BoxWithoutFeasiblePointIsAnError) {
  SearchProblem problem = pose_like_;
  problem.feasible = [](std::span<const double>) { return false; };
  EXPECT_THROW(Run(problem, PoseLikeEnergy, 50), InputError);
}

TEST_P(SamplerContract, SinglePointBoxIsProposedOnce) {
  SearchProblem problem;
  problem.box.parameters = {{"a", 2.0, 2.0}, {"b", -1.0, -1.0}};
  const Trace trace = Run(problem, Sphere, 50);
  ASSERT_EQ(trace.trials.size(), 1u);
  EXPECT_EQ(trace.trials[0].values, (std::vector<double>{2.0, -1.0}));
  problem.feasible = [](std::span<const double>) { return false; };
  EXPECT_THROW(Run(problem, Sphere, 50), InputError);
}

TEST_P(SamplerContract, FirstGuessIsProposedFirst) {
  SearchProblem problem = pose_like_;
  problem.start = {1.0, 2.0, 1.7, 90.0, 0.5};
  const Trace trace = Run(problem, PoseLikeEnergy, 60);
  EXPECT_EQ(trace.trials.size(), 60u);
  for (std::size_t i = 0; i < 5; ++i) {
    EXPECT_NEAR(trace.trials[0].values[i], problem.start[i], 1e-12);
  }
}

TEST_P(SamplerContract, InadmissibleFirstGuessIsSkipped) {
  SearchProblem problem = pose_like_;
  problem.start = {1.0, 2.0, 1.7, 90.0, 0.5};
  problem.feasible = [](std::span<const double> v) { return v[0] < 0.0; };
  const Trace trace = Run(problem, PoseLikeEnergy, 60);
  EXPECT_EQ(trace.trials.size(), 60u);
  for (const Trial& trial : trace.trials) EXPECT_LT(trial.values[0], 0.0);
}

TEST_P(SamplerContract, FailuresAndInfeasibleResultsDoNotStopTheSearch) {
  const auto moody = [](std::span<const double> v) {
    if (v[0] > 12.0) throw std::runtime_error("no view");
    if (v[0] < -12.0) return std::numeric_limits<double>::quiet_NaN();
    if (v[1] < -12.0) return kInfinity;
    if (v[1] > 16.0) return -kInfinity;
    return PoseLikeEnergy(v);
  };
  const Trace trace = Run(pose_like_, moody, 200, 4, 2);
  ASSERT_EQ(trace.trials.size(), 200u);
  for (const Trial& trial : trace.trials) {
    const auto& v = trial.values;
    TrialState expected = TrialState::kComplete;
    if (std::abs(v[0]) > 12.0 || v[1] > 16.0) expected = TrialState::kFailed;
    if (std::abs(v[0]) <= 12.0 && v[1] < -12.0) expected = TrialState::kInfeasible;
    EXPECT_EQ(trial.state, expected);
    if (v[0] > 12.0) {
      EXPECT_EQ(trial.message, "no view");
    }
  }
  ASSERT_NE(trace.Best(), nullptr);
  EXPECT_LT(trace.Best()->energy, 0.5);
}

TEST_P(SamplerContract, ScoreThatAlwaysFailsSpendsTheBudgetAndHasNoBest) {
  for (const double value : {std::nan(""), kInfinity, -kInfinity}) {
    const Trace trace = Run(
        pose_like_, [&](std::span<const double>) { return value; }, 60, 4);
    EXPECT_EQ(trace.trials.size(), 60u);
    EXPECT_EQ(trace.Best(), nullptr);
  }
}

TEST_P(SamplerContract, FlatEnergyIsNoObstacle) {
  const Trace trace = Run(
      pose_like_, [](std::span<const double>) { return 1.0; }, 150, 4);
  std::set<std::vector<double>> points;
  for (const Trial& trial : trace.trials) points.insert(trial.values);
  EXPECT_GT(points.size(), 100u);
}

TEST_P(SamplerContract, OneParameterAndPeriodicOneParameter) {
  for (const bool periodic : {false, true}) {
    SearchProblem problem;
    problem.box.parameters = {{"heading_deg", -180.0, 180.0, periodic}};
    const auto energy = [](std::span<const double> v) {
      return 1.0 - std::cos((v[0] - 179.0) * std::numbers::pi / 180.0);
    };
    const Trace trace = Run(problem, energy, 60, 1);
    EXPECT_EQ(trace.trials.size(), 60u);
    EXPECT_LT(trace.Best()->energy, 0.05);  // within 18 degrees: one point in ten
  }
}

TEST_P(SamplerContract, BeatsTheMeanOfRandomPoints) {
  // The median of random points is 0.9, their least of 200 in four dimensions about 0.05.
  EXPECT_LT(Run(pose_like_, PoseLikeEnergy, 200).Best()->energy, 0.15);
}

TEST_P(SamplerContract, WrongTellsAreErrors) {
  const auto sampler = Make(pose_like_);
  Trial trial = sampler->Ask(1).at(0);
  EXPECT_THROW(sampler->Tell(trial), InputError);  // no result
  trial.SetEnergy(0.5);

  Trial changed = trial;
  changed.values[0] = changed.values[0] > 0.0 ? -1.0 : 1.0;
  EXPECT_THROW(sampler->Tell(changed), InputError);
  changed.values[0] = 21.0;
  EXPECT_THROW(sampler->Tell(changed), InputError);
  changed.values = {0.0};
  EXPECT_THROW(sampler->Tell(changed), InputError);
  changed.values.assign(5, std::nan(""));
  EXPECT_THROW(sampler->Tell(changed), InputError);
  changed = trial;
  changed.index = 77;
  EXPECT_THROW(sampler->Tell(changed), InputError);
  changed = trial;
  changed.energy = std::nan("");
  EXPECT_THROW(sampler->Tell(changed), InputError);

  sampler->Tell(trial);
  EXPECT_THROW(sampler->Tell(trial), InputError);  // twice
}

TEST_P(SamplerContract, OwnTrialsAreTaken) {
  const auto sampler = Make(pose_like_);
  Trial own;
  own.values = {3.0, -4.0, 1.7, 358.0, 1.0};
  own.SetEnergy(0.0);
  for (int round = 0; round < 30; ++round) {
    sampler->Tell(own);
    for (Trial& trial : sampler->Ask(3)) {
      trial.SetEnergy(PoseLikeEnergy(trial.values));
      sampler->Tell(trial);
    }
  }
  own.values[0] = 100.0;
  EXPECT_THROW(sampler->Tell(own), InputError);
}

INSTANTIATE_TEST_SUITE_P(All,
                         SamplerContract,
                         testing::ValuesIn(SamplerNames()),
                         [](const auto& test) { return test.param; });

TEST(SamplerTable, ANameThatIsTakenIsRefused) {
  const std::size_t before = SamplerTable().size();
  EXPECT_THROW(AddSampler(*SamplerTable().front()), InputError);
  EXPECT_EQ(SamplerTable().size(), before);
}

}  // namespace
}  // namespace ridgeline
