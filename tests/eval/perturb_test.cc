// SPDX-License-Identifier: Apache-2.0
#include "eval/perturb.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/error.h"

namespace ridgeline {
namespace {

TEST(DrawPrior, DependsOnSeedAndIdAloneAndStaysInRange) {
  const Pose truth{CamFromWorld(ViewAngles{350.0, 3.0, -2.0}), {1000.0, 2000.0, 300.0}};
  const Perturbation half{10.0, 5.0, 1.0, 20.0, 4.0, 3.0};
  const PosePrior once = DrawPrior(truth, half, 1, "007");
  EXPECT_EQ(DrawPrior(truth, half, 1, "007").position_in_world, once.position_in_world);
  EXPECT_NE(DrawPrior(truth, half, 2, "007").position_in_world, once.position_in_world);
  EXPECT_NE(DrawPrior(truth, half, 1, "008").position_in_world, once.position_in_world);
  double mean_east = 0.0;
  for (int seed = 0; seed < 2000; ++seed) {
    const PosePrior prior = DrawPrior(truth, half, seed, "007");
    mean_east += (prior.position_in_world.x() - 1000.0) / 2000.0;
    EXPECT_LE(std::abs(prior.position_in_world.x() - 1000.0), 10.0);
    EXPECT_LE(std::abs(prior.position_in_world.y() - 2000.0), 5.0);
    EXPECT_LE(std::abs(*prior.height_in_world - 300.0), 1.0);
    EXPECT_LE(std::abs(HeadingDifferenceDeg(*prior.heading_deg, 350.0)), 20.0 + 1e-9);
    EXPECT_LE(std::abs(*prior.pitch_deg - 3.0), 4.0 + 1e-9);
    EXPECT_LE(std::abs(*prior.roll_deg + 2.0), 3.0 + 1e-9);
  }
  // Standard error of the mean: 10 / sqrt(3) / sqrt(2000) = 0.13; five of them.
  EXPECT_NEAR(mean_east, 0.0, 0.65);
}

TEST(ParsePerturbation, TakesFourOrSixNumbers) {
  EXPECT_EQ(ParsePerturbation("10,10,0,20").heading_deg, 20.0);
  EXPECT_EQ(ParsePerturbation("10,10,10,15,5,4").roll_deg, 4.0);
  for (const char* bad : {"", "10,10,0", "10,10,0,x", "10,10,0,-20", "1,2,3,4,5"}) {
    EXPECT_THROW(ParsePerturbation(bad), InputError) << bad;
  }
}

}  // namespace
}  // namespace ridgeline
