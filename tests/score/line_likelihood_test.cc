// SPDX-License-Identifier: Apache-2.0
#include "score/line_likelihood.h"

#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/core.hpp>

namespace ridgeline {
namespace {

constexpr int kWidth = 400;
constexpr int kHeight = 300;
const PinholeCamera kCamera{kWidth, kHeight, 400.0, 400.0, 200.0, 150.0};

double RatioOfHorizontal(const OrientedDistanceField& field, float y, float depth_m = 1000.0f) {
  const LineLikelihood likelihood(field, kCamera, {});
  ProjectedSegment segment;
  segment.a = {100.0f, y};
  segment.b = {300.0f, y};
  segment.inverse_depth_a = segment.inverse_depth_b = 1.0f / depth_m;
  const std::vector<EdgeKind> kinds = {EdgeKind::kSkyline};
  const auto ratios = likelihood.LogRatios({&segment, 1}, kinds);
  return ratios[static_cast<int>(EdgeKind::kSkyline)];
}

TEST(OrientedDistanceField, DistancesAreThoseToSegmentsOfTheDirection) {
  const OrientedDistanceField field({{{50, 100.5f}, {350, 100.5f}, 1.0f}}, kWidth, kHeight, 1);
  const int horizontal = OrientedDistanceField::DirectionOf(1.0f, 0.0f);
  const int vertical = OrientedDistanceField::DirectionOf(0.0f, 1.0f);
  EXPECT_EQ(field.Distance(horizontal, 200, 100), 0);
  for (const int d : {1, 5, 20}) {
    // Exact along the axes but for the place within a cell of two pixels.
    EXPECT_NEAR(field.Distance(horizontal, 200, 100 + d), 8 * d, 8);
  }
  EXPECT_EQ(field.Distance(horizontal, 200, 200), 255);
  EXPECT_EQ(field.Distance(vertical, 200, 100), 255);
}

TEST(OrientedDistanceField, OppositeDirectionsShareABin) {
  for (int k = 0; k < 36; ++k) {
    const float angle = (static_cast<float>(k) + 0.37f) * static_cast<float>(M_PI) / 18.0f;
    EXPECT_EQ(OrientedDistanceField::DirectionOf(std::cos(angle), std::sin(angle)),
              OrientedDistanceField::DirectionOf(-std::cos(angle), -std::sin(angle)));
  }
}

TEST(OrientedDistanceField, FourDirectionsAtOnceAreThoseOneByOne) {
  for (int k = 0; k < 720; k += 4) {
    simd::Float4 dx;
    simd::Float4 dy;
    for (int lane = 0; lane < 4; ++lane) {
      // Not on the borders of the bins.
      const double angle = (k + lane + 0.3) * M_PI / 360.0;
      dx[lane] = static_cast<float>(7.0 * std::cos(angle));
      dy[lane] = static_cast<float>(7.0 * std::sin(angle));
    }
    const simd::Int4 directions = OrientedDistanceField::DirectionsOf(dx, dy);
    for (int lane = 0; lane < 4; ++lane) {
      EXPECT_EQ(directions[lane], OrientedDistanceField::DirectionOf(dx[lane], dy[lane]));
    }
  }
}

TEST(OrientedDistanceField, IsTheSameOnAnyNumberOfThreads) {
  const std::vector<LineSegment> segments = {{{10, 20}, {200, 250}, 1}, {{300, 10}, {310, 200}, 1}};
  const OrientedDistanceField one(segments, kWidth, kHeight, 1);
  const OrientedDistanceField many(segments, kWidth, kHeight, 8);
  for (int d = 0; d < OrientedDistanceField::kDirections; ++d) {
    for (int y = 0; y < kHeight; y += 7) {
      for (int x = 0; x < kWidth; x += 7) {
        ASSERT_EQ(one.Distance(d, x, y), many.Distance(d, x, y));
        ASSERT_EQ(one.DensityLevel(d, x, y), many.DensityLevel(d, x, y));
      }
    }
  }
}

TEST(LineLikelihood, FallsWithTheDistanceToTheLine) {
  const OrientedDistanceField field({{{100, 150.5f}, {300, 150.5f}, 1.0f}}, kWidth, kHeight, 1);
  double last = RatioOfHorizontal(field, 150.5f);
  EXPECT_GT(last, 0.0);
  for (const float d : {1.0f, 2.0f, 4.0f, 8.0f, 16.0f}) {
    const double ratio = RatioOfHorizontal(field, 150.5f + d);
    EXPECT_LE(ratio, last);
    last = ratio;
  }
  EXPECT_LT(last, 0.0);
}

TEST(LineLikelihood, FarFromAllLinesASampleCountsTheShareOfUnseenEdges) {
  const OrientedDistanceField field({}, kWidth, kHeight, 1);
  const LineLikelihoodOptions options;
  const double samples = 200.0 / (options.spacing_width * kWidth);
  // Whole samples at the nearest spacing.
  EXPECT_NEAR(RatioOfHorizontal(field, 150.0f),
              samples * std::log(1.0 - options.seen_share[0]),
              0.01 * samples);
}

TEST(LineLikelihood, NearEdgesAreMoreTolerantThanFarOnes) {
  const OrientedDistanceField field({{{100, 150.5f}, {300, 150.5f}, 1.0f}}, kWidth, kHeight, 1);
  EXPECT_GT(RatioOfHorizontal(field, 158.5f, 5.0f), RatioOfHorizontal(field, 158.5f, 500.0f));
  EXPECT_LT(RatioOfHorizontal(field, 150.5f, 5.0f), RatioOfHorizontal(field, 150.5f, 500.0f));
}

TEST(LineLikelihood, AHitInClutterCountsLess) {
  const LineSegment line{{100, 150.5f}, {300, 150.5f}, 1.0f};
  std::vector<LineSegment> clutter = {line};
  for (int k = 1; k < 20; ++k) {
    clutter.push_back({{100, 150.5f + 6.0f * k}, {300, 150.5f + 6.0f * k}, 1.0f});
    clutter.push_back({{100, 150.5f - 6.0f * k}, {300, 150.5f - 6.0f * k}, 1.0f});
  }
  const OrientedDistanceField alone({line}, kWidth, kHeight, 1);
  const OrientedDistanceField among(clutter, kWidth, kHeight, 1);
  EXPECT_LT(RatioOfHorizontal(among, 150.5f), RatioOfHorizontal(alone, 150.5f));
}

TEST(LineLikelihood, WhereSomethingHidesTheEdgeItCountsNothing) {
  const std::vector<LineSegment> lines = {{{100, 150.5f}, {300, 150.5f}, 1.0f}};
  cv::Mat hidden = cv::Mat::zeros(kHeight, kWidth, CV_8U);
  const OrientedDistanceField free(lines, kWidth, kHeight, 1, hidden);
  hidden.colRange(0, 200).setTo(255);
  const OrientedDistanceField half(lines, kWidth, kHeight, 1, hidden);
  hidden.setTo(255);
  const OrientedDistanceField none(lines, kWidth, kHeight, 1, hidden);
  const OrientedDistanceField seen(lines, kWidth, kHeight, 1);
  for (const float y : {150.5f, 153.5f, 250.5f}) {
    const double all = RatioOfHorizontal(seen, y);
    EXPECT_EQ(RatioOfHorizontal(free, y), all);
    // The line runs from 100 to 300.
    EXPECT_NEAR(RatioOfHorizontal(half, y), 0.5 * all, 0.02 * std::abs(all));
    EXPECT_EQ(RatioOfHorizontal(none, y), 0.0);
  }
}

TEST(LineLikelihood, NoSegmentsCountNothing) {
  const OrientedDistanceField field({}, kWidth, kHeight, 1);
  for (const float ratio : LineLikelihood(field, kCamera, {}).LogRatios({}, {})) {
    EXPECT_EQ(ratio, 0.0f);
  }
}

}  // namespace
}  // namespace ridgeline
