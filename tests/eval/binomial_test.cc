// SPDX-License-Identifier: Apache-2.0
#include "eval/binomial.h"

#include <gtest/gtest.h>

#include <cmath>

namespace ridgeline {
namespace {

TEST(WilsonInterval, MatchesTheTextbook) {
  // 8 of 10 at 95 %: statsmodels proportion_confint(8, 10, method="wilson").
  const Interval95 interval = WilsonInterval(0.8, 10);
  EXPECT_NEAR(interval.lower, 0.4901625, 1e-6);
  EXPECT_NEAR(interval.upper, 0.9433178, 1e-6);
}

TEST(WilsonInterval, NeverClosesOnAPoint) {
  // All of n: 1 / (1 + z^2 / n).
  EXPECT_NEAR(WilsonInterval(1.0, 8).lower, 1.0 / (1.0 + 3.841458820694124 / 8.0), 1e-9);
  EXPECT_DOUBLE_EQ(WilsonInterval(1.0, 8).upper, 1.0);
  EXPECT_DOUBLE_EQ(WilsonInterval(0.0, 8).lower, 0.0);
  EXPECT_DOUBLE_EQ(WilsonInterval(0.0, 0).upper, 1.0);
}

TEST(ExactInterval, MatchesTheTextbook) {
  // scipy.stats.binomtest(k, n).proportion_ci(method="exact").
  EXPECT_NEAR(ExactInterval(8, 10).lower, 0.44390454, 1e-7);
  EXPECT_NEAR(ExactInterval(8, 10).upper, 0.97478927, 1e-7);
  // None of n: 1 - (0.025)^(1/n), all of n: its mirror.
  EXPECT_NEAR(ExactInterval(0, 300).upper, 1.0 - std::pow(0.025, 1.0 / 300.0), 1e-9);
  EXPECT_DOUBLE_EQ(ExactInterval(0, 300).lower, 0.0);
  EXPECT_NEAR(ExactInterval(300, 300).lower, std::pow(0.025, 1.0 / 300.0), 1e-9);
  EXPECT_DOUBLE_EQ(ExactInterval(300, 300).upper, 1.0);
}

TEST(ExactInterval, HoldsForTenThousandTrials) {
  // 100 of 10 000: the Poisson limit is 0.00814 to 0.01216.
  const Interval95 interval = ExactInterval(100, 10000);
  EXPECT_NEAR(interval.lower, 0.00814, 2e-5);
  EXPECT_NEAR(interval.upper, 0.01216, 2e-5);
}

}  // namespace
}  // namespace ridgeline
