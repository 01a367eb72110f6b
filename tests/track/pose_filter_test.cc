// SPDX-License-Identifier: Apache-2.0
#include "track/pose_filter.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace ridgeline {
namespace {

PoseRegion Region() {
  PoseRegion region;
  region.half_m = 20.0;
  region.height_at = [](const Eigen::Vector2d&) { return 2.0; };
  return region;
}

PoseVector Vector(double e, double n, double heading) {
  PoseVector v;
  v << e, n, 2.0, heading, 0.0, 0.0;
  return v;
}

// A picture's log ratio: a peak at each of the places, nothing elsewhere.
PoseFilter::LogRatios Peaks(std::vector<PoseVector> places, double height_nat = 40.0) {
  return [=](std::span<const Pose> poses) {
    std::vector<double> log_ratios;
    for (const Pose& pose : poses) {
      double best = 0.0;
      for (const PoseVector& place : places) {
        const PoseVector d = DifferenceOf(VectorOf(pose), place);
        const double square = d.head<3>().squaredNorm() / 0.04 + d.tail<3>().squaredNorm() / 0.09;
        best = std::max(best, height_nat * std::exp(-0.05 * square));
      }
      log_ratios.push_back(best);
    }
    return log_ratios;
  };
}

std::vector<PoseFilter::Proposal> Proposals(const std::vector<PoseVector>& places) {
  std::vector<PoseFilter::Proposal> proposals;
  for (const PoseVector& place : places) proposals.push_back({place, 40.0});
  return proposals;
}

Motion Ahead(double metres) {
  Motion motion;
  motion.step_in_before = {0.0, 0.0, metres};
  motion.sigma_m = 0.1;
  motion.sigma_deg = 0.2;
  return motion;
}

TEST(PoseFilter, OdometryTellsTwinPlacesApart) {
  // The picture fits two places; only one of them moves on as the odometry says.
  PoseFilter filter(PoseFilterOptions{});
  filter.Start(Region());
  const std::vector<PoseVector> first = {Vector(-8.0, 0.0, 0.0), Vector(8.0, 0.0, 180.0)};
  Random random(1, 1);
  filter.Update(Peaks(first), nullptr, Proposals(first), 1.0, random);
  EXPECT_NEAR(filter.Belief().main.mass, 0.5, 0.2);
  const std::vector<PoseVector> second = {Vector(-8.0, 4.0, 0.0), Vector(8.0, 4.0, 180.0)};
  filter.Predict(Ahead(4.0));
  filter.Update(Peaks(second), nullptr, Proposals(second), 1.0, random);
  const PoseBelief belief = filter.Belief();
  EXPECT_GT(belief.main.mass, 0.97);
  EXPECT_LT((belief.main.mean - second[0]).head<3>().norm(), 0.15);
  EXPECT_LT(std::sqrt(belief.main.covariance(0, 0)), 0.3);
}

TEST(PoseFilter, OneLyingPictureDoesNotKillTheTruth) {
  PoseFilter filter(PoseFilterOptions{});
  filter.Start(Region());
  Random random(2, 1);
  double n = 0.0;
  filter.Update(Peaks({Vector(0.0, n, 0.0)}), nullptr, Proposals({Vector(0.0, n, 0.0)}), 1.0, random);
  for (int i = 0; i < 4; ++i) {
    n += 4.0;
    filter.Predict(Ahead(4.0));
    // The third picture says, as loudly as it can, that the camera is elsewhere.
    const PoseVector seen = i == 2 ? Vector(10.0, n - 6.0, 90.0) : Vector(0.0, n, 0.0);
    filter.Update(Peaks({seen}, 200.0), nullptr, Proposals({seen}), 1.0, random);
  }
  const PoseBelief belief = filter.Belief();
  EXPECT_LT((belief.main.mean - Vector(0.0, 16.0, 0.0)).head<3>().norm(), 0.3);
  EXPECT_GT(belief.main.mass, 0.9);
}

TEST(PoseFilter, UncertaintyGrowsWithTheWayAndShrinksWithALook) {
  PoseFilter filter(PoseFilterOptions{});
  filter.Start(Region());
  Random random(3, 1);
  filter.Update(
      Peaks({Vector(0.0, 0.0, 0.0)}), nullptr, Proposals({Vector(0.0, 0.0, 0.0)}), 1.0, random);
  const double before = filter.Belief().main.covariance(1, 1);
  Motion slow = Ahead(5.0);
  slow.scale_sigma = 0.2;
  for (int i = 0; i < 2; ++i) filter.Predict(slow);
  const PoseBelief blind = filter.Belief();
  EXPECT_NEAR(std::sqrt(blind.main.covariance(1, 1)), 2.0, 0.4);  // 20 % of 10 m
  EXPECT_LT(std::sqrt(blind.main.covariance(0, 0)), 0.6);         // but not aside
  filter.Update(Peaks({Vector(0.0, 11.0, 0.0)}), nullptr, {}, 1.0, random);
  EXPECT_LT(filter.Belief().main.covariance(1, 1), 4.0 * before + 0.01);
  EXPECT_NEAR(filter.Belief().main.mean(1), 11.0, 0.3);
}

TEST(PoseFilter, APictureThatSeesNothingLeavesThePrediction) {
  PoseFilter filter(PoseFilterOptions{});
  filter.Start(Region());
  Random random(4, 1);
  filter.Update(
      Peaks({Vector(0.0, 0.0, 0.0)}), nullptr, Proposals({Vector(0.0, 0.0, 0.0)}), 1.0, random);
  filter.Predict(Ahead(3.0));
  filter.Update(
      [](std::span<const Pose> poses) {
        return std::vector<double>(poses.size(), -std::numeric_limits<double>::infinity());
      },
      nullptr,
      {},
      1.0,
      random);
  EXPECT_NEAR(filter.Belief().main.mean(1), 3.0, 0.2);
}

TEST(PoseFilter, TheSameSeedGivesTheSameBelief) {
  const auto run = [] {
    PoseFilter filter(PoseFilterOptions{});
    filter.Start(Region());
    Random random(5, 1);
    filter.Update(
        Peaks({Vector(1.0, 2.0, 10.0)}), nullptr, Proposals({Vector(1.0, 2.0, 10.0)}), 1.0, random);
    return filter.Belief().main.mean;
  };
  EXPECT_EQ(run(), run());
}

}  // namespace
}  // namespace ridgeline
