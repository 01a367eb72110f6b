// SPDX-License-Identifier: Apache-2.0
#include "track/downhill_simplex.h"

#include <gtest/gtest.h>

#include <cmath>

namespace ridgeline {
namespace {

double Rosenbrock(std::span<const double> x) {
  return 100.0 * std::pow(x[1] - x[0] * x[0], 2) + std::pow(1.0 - x[0], 2);
}

TEST(MinimizeBySimplex, FindsTheMinimumOfRosenbrocksValley) {
  const SimplexResult result = MinimizeBySimplex(
      Rosenbrock, {-1.2, 1.0}, {{0.5, 0.5}, {0.1, 0.1}, {0.02, 0.02}}, {1e-12, 400});
  EXPECT_NEAR(result.point[0], 1.0, 1e-4);
  EXPECT_NEAR(result.point[1], 1.0, 1e-4);
}

TEST(MinimizeBySimplex, KeepsVariablesWithoutAStep) {
  const SimplexResult result =
      MinimizeBySimplex(Rosenbrock, {0.5, 1.0}, {{0.0, 0.3}}, {1e-12, 200});
  EXPECT_EQ(result.point[0], 0.5);
  EXPECT_NEAR(result.point[1], 0.25, 1e-4);
}

TEST(MinimizeBySimplex, IsNeverWorseThanTheStartAndCountsItsEvaluations) {
  int calls = 0;
  const auto counted = [&](std::span<const double> x) {
    ++calls;
    return std::abs(x[0]) + std::abs(x[1]);
  };
  const SimplexResult result = MinimizeBySimplex(counted, {0.0, 0.0}, {{1.0, 1.0}}, {1e-9, 50});
  EXPECT_EQ(result.value, 0.0);
  EXPECT_EQ(result.evaluations, calls);
}

}  // namespace
}  // namespace ridgeline
