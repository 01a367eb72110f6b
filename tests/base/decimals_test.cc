// SPDX-License-Identifier: Apache-2.0
#include "base/decimals.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>

#include "base/random.h"

namespace ridgeline {
namespace {

TEST(RoundedTo, HasNoMoreDigitsThanAskedFor) {
  EXPECT_EQ(ShortestText(RoundedTo(690909.2150000001, 4)), "690909.215");
  EXPECT_EQ(ShortestText(RoundedTo(0.1 + 0.2, 9)), "0.3");
  EXPECT_EQ(ShortestText(RoundedTo(-0.00001, 4)), "0");
  EXPECT_EQ(RoundedTo(2.5, 0), 3.0);
  // The nearest double to a decimal is the one that its text reads as.
  Random random(1, HashText("RoundedTo"));
  for (int i = 0; i < 10000; ++i) {
    const double value = random.Uniform(-6e6, 6e6);
    const double rounded = RoundedTo(value, 7);
    char text[64];
    std::snprintf(text, sizeof(text), "%.7f", rounded);
    EXPECT_EQ(std::strtod(text, nullptr), rounded);
    EXPECT_NEAR(rounded, value, 0.5000001e-7 + 1e-9);
  }
}

TEST(RoundedTo, LeavesWhatCannotBeRounded) {
  EXPECT_TRUE(std::isnan(RoundedTo(NAN, 3)));
  EXPECT_EQ(RoundedTo(INFINITY, 3), INFINITY);
  EXPECT_EQ(RoundedTo(1e300, 3), 1e300);
}

}  // namespace
}  // namespace ridgeline
