// SPDX-License-Identifier: Apache-2.0
#include "skyline/clean_skyline.h"

#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/imgproc.hpp>

#include "base/random.h"

namespace ridgeline {
namespace {

TEST(RemoveAberrantPoints, FollowsAlgorithmOne) {
  // |y[i+1] + y[i-1] - 2 y[i]|: 0 at 1, 10 at 2, 20 at 3, 10 at 4, 0 at 5.
  const Polyline line{{0, 5}, {1, 5}, {2, 5}, {3, 15}, {4, 5}, {5, 5}, {6, 5}};
  EXPECT_EQ(RemoveAberrantPoints(line, 10.5).size(), 6u);
  EXPECT_EQ(RemoveAberrantPoints(line, 9.0).size(), 4u);
  EXPECT_EQ(RemoveAberrantPoints(line, 21.0).size(), 7u);
}

TEST(RemoveAberrantPoints, KeepsAllAtPrecisionZero) {
  const Polyline line{{0, 5}, {1, 50}, {2, 5}};
  EXPECT_EQ(RemoveAberrantPoints(line, 0.0), line);
}

TEST(SimplifyPolyline, AgreesWithOpenCv) {
  Random random(HashText("SimplifyPolyline"), 0);
  for (int round = 0; round < 20; ++round) {
    Polyline line;
    std::vector<cv::Point2f> points;
    double y = 100.0;
    for (int x = 0; x < 120; ++x) {
      y += random.Uniform(-6.0, 6.0);
      line.emplace_back(x, y);
      points.emplace_back(static_cast<float>(x), static_cast<float>(y));
    }
    std::vector<cv::Point2f> expected;
    cv::approxPolyDP(points, expected, 8.0, false);
    const Polyline simple = SimplifyPolyline(line, 8.0);
    // OpenCV measures to the line, we to the segment, and it drops points once more at the end.
    EXPECT_NEAR(static_cast<double>(simple.size()), static_cast<double>(expected.size()), 2.0);
  }
}

TEST(SimplifyPolyline, LeavesNoPointFartherThanThePrecision) {
  Random random(HashText("SimplifyPolyline"), 1);
  Polyline line;
  for (int x = 0; x < 300; ++x) line.emplace_back(x, 40.0 * std::sin(x * 0.05) + random.Normal());
  const Polyline simple = SimplifyPolyline(line, 3.0);
  ASSERT_LT(simple.size(), 60u);
  for (const Eigen::Vector2d& p : line) {
    double nearest = 1e9;
    for (std::size_t i = 1; i < simple.size(); ++i) {
      const Eigen::Vector2d d = simple[i] - simple[i - 1];
      const double t = std::clamp((p - simple[i - 1]).dot(d) / d.squaredNorm(), 0.0, 1.0);
      nearest = std::min(nearest, (p - simple[i - 1] - t * d).norm());
    }
    EXPECT_LE(nearest, 3.0 + 1e-9);
  }
}

TEST(CleanSkyline, RemovesASpikeAndLeavesUnknownColumnsAlone) {
  Skyline skyline;
  skyline.image_width = 40;
  skyline.image_height = 30;
  for (int i = 0; i < 40; ++i) {
    skyline.y_px.push_back(i == 10 ? 25.0f : 12.0f);
    skyline.confidence.push_back(1.0f);
    skyline.columns.push_back(i < 30 ? SkylineColumn::kSeen : SkylineColumn::kUnknown);
  }
  skyline.y_px[35] = 3.0f;
  const Skyline clean = CleanSkyline(skyline, 2.0);
  EXPECT_NEAR(clean.y_px[10], 12.0f, 1e-4);
  EXPECT_EQ(clean.y_px[35], 3.0f);
}

}  // namespace
}  // namespace ridgeline
