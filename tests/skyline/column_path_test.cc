// SPDX-License-Identifier: Apache-2.0
#include "skyline/column_path.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <limits>

#include "base/random.h"

namespace ridgeline {
namespace {

ColumnCosts RandomCosts(int columns, int rows, std::uint64_t seed) {
  Random random(HashText("ColumnPath"), seed);
  ColumnCosts costs{columns, rows, {}, {}};
  for (int i = 0; i < columns * (rows + 1); ++i) {
    costs.unary.push_back(static_cast<float>(random.Uniform(-1.0, 1.0)));
  }
  for (int i = 0; i < columns * rows; ++i) {
    costs.step.push_back(static_cast<float>(random.Uniform(0.0, 0.5)));
  }
  return costs;
}

double PathCost(const ColumnCosts& costs, const std::vector<int>& states) {
  double sum = 0.0;
  for (int c = 0; c < costs.columns; ++c) {
    const int s = states[static_cast<std::size_t>(c)];
    sum += costs.unary[static_cast<std::size_t>(c * (costs.rows + 1) + s)];
    if (c + 1 == costs.columns) break;
    const int next = states[static_cast<std::size_t>(c + 1)];
    for (int r = std::min(s, next); r < std::max(s, next); ++r) {
      sum += costs.step[static_cast<std::size_t>(c * costs.rows + r)];
    }
  }
  return sum;
}

// All paths, by counting in base rows + 1.
template <typename Visit>
void ForEachPath(const ColumnCosts& costs, const Visit& visit) {
  std::vector<int> states(static_cast<std::size_t>(costs.columns), 0);
  while (true) {
    visit(states, PathCost(costs, states));
    std::size_t c = 0;
    while (c < states.size() && ++states[c] > costs.rows) states[c++] = 0;
    if (c == states.size()) return;
  }
}

TEST(ColumnPath, IsTheCheapestOfAllPathsWithItsExactMargins) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const ColumnCosts costs = RandomCosts(5, 6, seed);
    const int tolerance = static_cast<int>(seed % 3);
    const ColumnPath path = CheapestColumnPath(costs, tolerance);
    double least = std::numeric_limits<double>::infinity();
    ForEachPath(costs,
                [&](const std::vector<int>&, double cost) { least = std::min(least, cost); });
    EXPECT_NEAR(PathCost(costs, path.states), least, 1e-5) << "seed " << seed;
    for (std::size_t c = 0; c < path.states.size(); ++c) {
      double other = std::numeric_limits<double>::infinity();
      ForEachPath(costs, [&](const std::vector<int>& states, double cost) {
        if (std::abs(states[c] - path.states[c]) > tolerance) other = std::min(other, cost);
      });
      EXPECT_NEAR(path.margins[c], other - least, 1e-5) << "seed " << seed << " column " << c;
    }
  }
}

}  // namespace
}  // namespace ridgeline
