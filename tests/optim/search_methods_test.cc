// SPDX-License-Identifier: Apache-2.0
// What single samplers are expected to do beyond the contract.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "base/error.h"
#include "optim/batch_search.h"
#include "optim/functions.h"
#include "optim/gp_de.h"
#include "optim/grid_search.h"
#include "optim/minimize.h"
#include "optim/nelder_mead.h"
#include "optim/population.h"
#include "optim/sobol.h"
#include "optim/tpe.h"

namespace ridgeline {
namespace {

Trace Search(const SamplerOptions& options,
             const SearchProblem& problem,
             const Energy& energy,
             int budget,
             std::uint64_t seed = 1) {
  MinimizeOptions run;
  run.budget = budget;
  return Minimize(*MakeSampler(options, problem, seed), energy, run);
}

SamplerOptions Named(const std::string& name) {
  SamplerOptions options;
  options.name = name;
  return options;
}

// Any 2^k points from the start have one in each of 2^k slices of every axis, and each elementary
// interval of the first two axes.
TEST(SobolSequence, FirstPowersOfTwoAreEven) {
  for (const std::uint64_t seed : {1u, 2u}) {
    SobolSequence sequence(5, seed);
    std::vector<UnitPoint> points;
    for (int i = 0; i < 256; ++i) points.push_back(sequence.Next());
    for (const int count : {16, 256}) {
      for (int d = 0; d < 5; ++d) {
        std::set<int> slices;
        for (int i = 0; i < count; ++i) slices.insert(static_cast<int>(points[i][d] * count));
        EXPECT_EQ(static_cast<int>(slices.size()), count);
      }
      for (int wide = 1; wide < count; wide *= 2) {
        std::set<std::pair<int, int>> cells;
        for (int i = 0; i < count; ++i) {
          cells.emplace(static_cast<int>(points[i][0] * wide),
                        static_cast<int>(points[i][1] * count / wide));
        }
        EXPECT_EQ(static_cast<int>(cells.size()), count);
      }
    }
  }
}

TEST(NelderMead, ConvergesOnRosenbrock) {
  SearchProblem problem;
  problem.box = CubeBox(2, -2.0, 2.0);
  problem.start = {-1.2, 1.0};
  SamplerOptions options = Named("nelder_mead");
  options.groups.Get<NelderMeadOptions>().steps = {0.1, 0.05, 0.01, 0.001};
  EXPECT_LT(Search(options, problem, Rosenbrock, 300).Best()->energy, 1e-5);
}

TEST(NelderMead, FirstStepIsTheOptionsFractionOfTheRange) {
  SearchProblem problem;
  problem.box = CubeBox(3, 0.0, 10.0);
  problem.start = {5.0, 5.0, 9.0};
  SamplerOptions options = Named("nelder_mead");
  options.groups.Get<NelderMeadOptions>().steps = {0.2};
  const Trace trace = Search(options, problem, Sphere, 4);
  EXPECT_NEAR(trace.trials[1].values[0], 7.0, 1e-12);
  EXPECT_NEAR(trace.trials[2].values[1], 7.0, 1e-12);
  EXPECT_NEAR(trace.trials[3].values[2], 7.0, 1e-12);  // turned inwards
}

TEST(NelderMead, GroupsVaryTheirOwnVariables) {
  SearchProblem problem;
  problem.box = CubeBox(3, -1.0, 1.0);
  problem.start = {0.5, 0.5, 0.5};
  SamplerOptions options = Named("nelder_mead");
  options.groups.Get<NelderMeadOptions>().steps = {0.1};
  options.groups.Get<NelderMeadOptions>().groups = {"x1", "x0,x2"};
  const Trace trace = Search(options, problem, Sphere, 60);
  // First x1 alone, then the others with x1 at rest.
  std::size_t i = 1;
  for (; i < trace.trials.size() && trace.trials[i].values[0] == 0.5; ++i) {
    EXPECT_EQ(trace.trials[i].values[2], 0.5);
  }
  EXPECT_GT(i, 3u);
  const double x1 = trace.trials[i].values[1];
  EXPECT_NEAR(x1, 0.0, 0.05);
  EXPECT_EQ(trace.trials[i + 1].values[1], x1);

  options.groups.Get<NelderMeadOptions>().groups = {"x0,y1"};
  EXPECT_THROW(MakeSampler(options, problem, 1), InputError);
}

TEST(NelderMead, DecreasingStepsLeaveALocalMinimum) {
  // Ripples on a bowl: one small simplex stays in the first ripple.
  const auto rippled = [](std::span<const double> x) {
    return Sphere(x) + 0.1 * (1.0 - std::cos(20.0 * x[0]));
  };
  SearchProblem problem;
  problem.box = CubeBox(2, -1.0, 1.0);
  problem.start = {0.65, 0.6};
  SamplerOptions small = Named("nelder_mead");
  small.groups.Get<NelderMeadOptions>().steps = {0.01};
  SamplerOptions decreasing = small;
  decreasing.groups.Get<NelderMeadOptions>().steps = {0.3, 0.1, 0.03, 0.01};
  EXPECT_GT(Search(small, problem, rippled, 30).Best()->energy, 0.2);
  EXPECT_LT(Search(decreasing, problem, rippled, 150).Best()->energy, 0.01);
}

TEST(CmaEs, ConvergesOnRosenbrockAndOnAPeriodicSeam) {
  SearchProblem problem;
  problem.box = CubeBox(4, -2.0, 2.0);
  EXPECT_LT(Search(Named("cmaes"), problem, Rosenbrock, 3000).Best()->energy, 1e-3);
  EXPECT_LT(Search(Named("cmaes"), {PoseLikeBox(), {}, {}}, PoseLikeEnergy, 600).Best()->energy,
            1e-5);
}

TEST(DifferentialEvolution, ConvergesOnRosenbrockAndOnAPeriodicSeam) {
  SearchProblem problem;
  problem.box = CubeBox(3, -2.0, 2.0);
  EXPECT_LT(Search(Named("de"), problem, Rosenbrock, 3000).Best()->energy, 1e-2);
  EXPECT_LT(Search(Named("de"), {PoseLikeBox(), {}, {}}, PoseLikeEnergy, 1500).Best()->energy,
            1e-3);
}

TEST(GpDe, IsTheGaussianProcessFirstAndConvergesLikeDifferentialEvolution) {
  SearchProblem problem;
  problem.box = CubeBox(3, -2.0, 2.0);
  SamplerOptions options = Named("gp_de");
  options.groups.Get<GpDeOptions>().gp_trials = 40;
  const Trace trace = Search(options, problem, Rosenbrock, 3000);
  const Trace first = Search(Named("gp"), problem, Rosenbrock, 40);
  for (std::size_t i = 0; i < first.trials.size(); ++i) {
    EXPECT_EQ(trace.trials[i].values, first.trials[i].values);
  }
  // The best of the first is the first point of the second.
  const std::vector<double>& best = first.Best()->values;
  for (std::size_t d = 0; d < best.size(); ++d) {
    EXPECT_NEAR(trace.trials[40].values[d], best[d], 1e-12);
  }
  EXPECT_LT(trace.Best()->energy, 1e-2);
}

TEST(GridSearch, FindsANarrowMinimumAndEnds) {
  const auto narrow = [](std::span<const double> x) {
    return 1.0 - std::exp(-200.0 * ((x[0] - 0.31) * (x[0] - 0.31) + (x[1] + 0.47) * (x[1] + 0.47)));
  };
  SearchProblem problem;
  problem.box = CubeBox(2, -1.0, 1.0);
  const Trace trace = Search(Named("grid"), problem, narrow, 100000);
  EXPECT_LT(trace.trials.size(), 3000u);
  EXPECT_NEAR(trace.Best()->values[0], 0.31, 2e-4);
  EXPECT_NEAR(trace.Best()->values[1], -0.47, 2e-4);
}

TEST(GridSearch, TooManyDimensionsAreAnError) {
  SearchProblem problem;
  problem.box = CubeBox(30, -1.0, 1.0);
  EXPECT_THROW(Search(Named("grid"), problem, Sphere, 10), InputError);
}

TEST(GpSampler, FindsABraninMinimumInFewTrials) {
  const auto branin = [](std::span<const double> v) {
    constexpr double kPi = std::numbers::pi;
    const double a = v[1] - 5.1 / (4.0 * kPi * kPi) * v[0] * v[0] + 5.0 / kPi * v[0] - 6.0;
    return a * a + 10.0 * (1.0 - 1.0 / (8.0 * kPi)) * std::cos(v[0]) + 10.0;
  };
  SearchProblem problem;
  problem.box.parameters = {{"x", -5.0, 10.0}, {"y", 0.0, 15.0}};
  // The three minima are 0.397887.
  for (const std::uint64_t seed : {1u, 2u, 3u}) {
    EXPECT_LT(Search(Named("gp"), problem, branin, 45, seed).Best()->energy, 0.41);
  }
}

TEST(GpSampler, HoldsNoMoreThanItsPoints) {
  SamplerOptions options = Named("gp");
  options.groups.Get<GpOptions>().max_points = 40;
  const Trace trace = Search(options, {PoseLikeBox(), {}, {}}, PoseLikeEnergy, 150);
  EXPECT_EQ(trace.trials.size(), 150u);
  EXPECT_LT(trace.Best()->energy, 0.01);
}

// The plain bowl that Optuna's documentation starts with.
TEST(Tpe, ComesCloseOnABowl) {
  SearchProblem problem;
  problem.box = CubeBox(2, -10.0, 10.0);
  for (const char* name : {"tpe", "tpe_multivariate"}) {
    std::vector<double> best;
    for (std::uint64_t seed = 0; seed < 11; ++seed) {
      best.push_back(Search(Named(name), problem, Sphere, 100, seed).Best()->energy);
    }
    std::nth_element(best.begin(), best.begin() + 5, best.end());
    EXPECT_LT(best[5], 1.0) << name;
  }
}

TEST(Tpe, StartupIsUniformWhateverTheEnergies) {
  SearchProblem problem;
  problem.box = CubeBox(2, 0.0, 1.0);
  const Trace a = Search(Named("tpe"), problem, Sphere, 11);
  const Trace b = Search(Named("tpe"), problem, Rosenbrock, 11);
  for (std::size_t i = 0; i < 10; ++i) EXPECT_EQ(a.trials[i].values, b.trials[i].values);
}

TEST(FoldIntoCube, WrapsAndReflects) {
  const UnitPoint folded =
      FoldIntoCube({1.25, 1.25, -0.25, -0.25, 2.5}, {true, false, true, false, false});
  const UnitPoint expected = {0.25, 0.75, 0.75, 0.25, 0.5};
  for (std::size_t i = 0; i < expected.size(); ++i) EXPECT_NEAR(folded[i], expected[i], 1e-15);
}

TEST(SamplerOptions, BadValuesNameTheirField) {
  const auto message = [](auto change) {
    SamplerOptions options;
    change(options);
    try {
      CheckOptions(options, "sampler");
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_EQ(message([](SamplerOptions&) {}), "");
  EXPECT_EQ(message([](SamplerOptions& o) { o.name = "cma"; }).substr(0, 34),
            "sampler.name: got \"cma\", expected ");
  EXPECT_EQ(message([](SamplerOptions& o) { o.groups.Get<TpeOptions>().candidates = 0; }),
            "sampler.tpe.candidates: got 0, expected >= 1");
  EXPECT_EQ(
      message([](SamplerOptions& o) { o.groups.Get<TpeOptions>().good_fraction = std::nan(""); }),
      "sampler.tpe.good_fraction: got nan, expected (0, 1)");
  EXPECT_NE(message([](SamplerOptions& o) {
              o.groups.Get<NelderMeadOptions>().steps = {0.1, 0.0};
            }),
            "");
  EXPECT_NE(message([](SamplerOptions& o) { o.groups.Get<NelderMeadOptions>().steps.clear(); }),
            "");
  EXPECT_NE(message([](SamplerOptions& o) { o.groups.Get<CmaEsOptions>().sigma = -1.0; }), "");
  EXPECT_NE(
      message([](SamplerOptions& o) { o.groups.Get<DifferentialEvolutionOptions>().variant = 11; }),
      "");
  EXPECT_NE(message([](SamplerOptions& o) { o.groups.Get<GpOptions>().max_points = 0; }), "");
  EXPECT_NE(message([](SamplerOptions& o) { o.groups.Get<GridOptions>().finest = 0.0; }), "");
}

}  // namespace
}  // namespace ridgeline
