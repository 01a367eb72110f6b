// SPDX-License-Identifier: Apache-2.0
#include "projection/sector_test.h"

#include <gtest/gtest.h>

#include "base/random.h"

namespace ridgeline {
namespace {

constexpr double kPi = std::numbers::pi;

struct Limits {
  double center, half_width, lowest, highest;

  bool Contains(const Eigen::Vector3f& p) const {
    const double off = std::remainder(std::atan2(p.x(), p.y()) - center, 2.0 * kPi);
    const double elevation = std::atan2(p.z(), p.head<2>().norm());
    return std::abs(off) <= half_width && elevation >= lowest && elevation <= highest;
  }
};

Limits DrawLimits(Random& random) {
  const double middle = random.Uniform(-1.2, 1.2);
  const double half = random.Uniform(0.02, 0.5);
  return {random.Uniform(-kPi, kPi), random.Uniform(0.1, kPi), middle - half, middle + half};
}

Eigen::Vector3f DrawPoint(Random& random) {
  return {static_cast<float>(random.Uniform(-50.0, 50.0)),
          static_cast<float>(random.Uniform(-50.0, 50.0)),
          static_cast<float>(random.Uniform(-50.0, 50.0))};
}

TEST(SectorTest, NeverSaysNoToASegmentThatReachesIn) {
  Random random(3, 0);
  int refused = 0;
  for (int trial = 0; trial < 4000; ++trial) {
    const Limits limits = DrawLimits(random);
    const SectorTest test(limits.center, limits.half_width, limits.lowest, limits.highest);
    const Eigen::Vector3f a = DrawPoint(random);
    const Eigen::Vector3f b = DrawPoint(random);
    bool reaches = false;
    for (int i = 0; i <= 100; ++i) {
      reaches = reaches || limits.Contains(a + static_cast<float>(i) / 100.0f * (b - a));
    }
    const bool may = test.MayContainSegment(a, b);
    ASSERT_TRUE(may || !reaches) << trial;
    refused += may ? 0 : 1;
  }
  EXPECT_GT(refused, 400) << "a test that refuses nothing is of no use";
}

TEST(SectorTest, NeverSaysNoToABoxThatReachesIn) {
  Random random(4, 0);
  int refused = 0;
  for (int trial = 0; trial < 2000; ++trial) {
    const Limits limits = DrawLimits(random);
    const SectorTest test(limits.center, limits.half_width, limits.lowest, limits.highest);
    const Eigen::Vector3f center = DrawPoint(random);
    const Eigen::Vector3f extent = 0.2f * DrawPoint(random).cwiseAbs();
    bool reaches = false;
    for (int i = 0; i < 200; ++i) {
      const Eigen::Vector3f t(static_cast<float>(random.Uniform(-1.0, 1.0)),
                              static_cast<float>(random.Uniform(-1.0, 1.0)),
                              static_cast<float>(random.Uniform(-1.0, 1.0)));
      reaches = reaches || limits.Contains(center + extent.cwiseProduct(t));
    }
    const bool may = test.MayContainBox(center, extent);
    ASSERT_TRUE(may || !reaches) << trial;
    refused += may ? 0 : 1;
  }
  EXPECT_GT(refused, 200);
}

}  // namespace
}  // namespace ridgeline
