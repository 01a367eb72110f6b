// SPDX-License-Identifier: Apache-2.0
#include "base/random.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace ridgeline {
namespace {

TEST(MixBits, IsTheFinalizerOfSplitMix64) {
  // First outputs of SplitMix64 with seed 1234567 (published test vector of the Rosetta Code task
  // "Pseudo-random numbers/Splitmix64").
  std::uint64_t state = 1234567;
  std::vector<std::uint64_t> outputs;
  for (int i = 0; i < 3; ++i) outputs.push_back(MixBits(state += 0x9E3779B97F4A7C15ULL));
  EXPECT_EQ(outputs,
            (std::vector<std::uint64_t>{
                6457827717110365317ULL, 3203168211198807973ULL, 9817491932198370423ULL}));
}

TEST(HashText, IsFnv1a) {
  EXPECT_EQ(HashText(""), 0xCBF29CE484222325ULL);
  EXPECT_EQ(HashText("a"), 0xAF63DC4C8601EC8CULL);
  EXPECT_EQ(HashText("foobar"), 0x85944171F73967E8ULL);
}

TEST(Random, StreamsDifferByEveryPartOfTheKey) {
  const std::uint64_t base = Random(1, 2, 3).Next();
  EXPECT_EQ(Random(1, 2, 3).Next(), base);
  EXPECT_NE(Random(2, 2, 3).Next(), base);
  EXPECT_NE(Random(1, 3, 3).Next(), base);
  EXPECT_NE(Random(1, 2, 4).Next(), base);
}

TEST(Random, UniformHasMeanAndVarianceOfItsLaw) {
  Random random(5, 0);
  constexpr int kCount = 100000;
  double sum = 0.0;
  double squares = 0.0;
  for (int i = 0; i < kCount; ++i) {
    const double u = random.Uniform(-2.0, 4.0);
    ASSERT_GE(u, -2.0);
    ASSERT_LT(u, 4.0);
    sum += u;
    squares += u * u;
  }
  const double mean = sum / kCount;
  // Standard error of the mean is sqrt(3 / n) = 0.0055; five of them.
  EXPECT_NEAR(mean, 1.0, 0.028);
  EXPECT_NEAR(squares / kCount - mean * mean, 3.0, 0.05);
}

TEST(Random, NormalHasMeanAndVarianceOfItsLaw) {
  Random random(6, 0);
  constexpr int kCount = 100000;
  double sum = 0.0;
  double squares = 0.0;
  for (int i = 0; i < kCount; ++i) {
    const double z = random.Normal();
    sum += z;
    squares += z * z;
  }
  EXPECT_NEAR(sum / kCount, 0.0, 0.016);      // five standard errors
  EXPECT_NEAR(squares / kCount, 1.0, 0.0224);  // five standard errors
}

TEST(Random, BelowReachesEveryValue) {
  Random random(7, 0);
  std::vector<int> counts(5, 0);
  for (int i = 0; i < 5000; ++i) ++counts[random.Below(5)];
  for (const int count : counts) EXPECT_NEAR(count, 1000, 142);  // five standard deviations
}

TEST(NormalQuantile, InvertsTheDistributionFunction) {
  for (const double p : {1e-12, 1e-6, 0.01, 0.024, 0.025, 0.3, 0.5, 0.77, 0.975, 0.999999}) {
    const double x = NormalQuantile(p);
    EXPECT_NEAR(0.5 * std::erfc(-x / std::sqrt(2.0)) / p, 1.0, 1e-12);
  }
  EXPECT_NEAR(NormalQuantile(0.975), 1.959963984540054, 1e-13);
}

}  // namespace
}  // namespace ridgeline
