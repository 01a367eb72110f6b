// SPDX-License-Identifier: Apache-2.0
#include "score/sky_table.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/random.h"
#include "camera/pose.h"
#include "score/sky_score.h"

namespace ridgeline {
namespace {

constexpr int kColumns = 40;
constexpr int kRows = 60;
constexpr int kHorizon = 25;

// Sky above the horizon row, something else below.
cv::Mat ClearSky() {
  cv::Mat odds(kRows, kColumns, CV_32F, cv::Scalar(-4.0f));
  odds.rowRange(0, kHorizon) = 4.0f;
  return odds;
}

TEST(SkyTable, TheTrueHorizonIsTheBestHeight) {
  const SkyTable table(ClearSky(), {});
  for (int row = 0; row <= kRows; ++row) {
    if (row != kHorizon) {
      EXPECT_LT(table.LogRatio(3, static_cast<float>(row)), table.LogRatio(3, kHorizon));
    }
  }
  EXPECT_GT(table.LogRatio(3, kHorizon), 0.0f);
}

TEST(SkyTable, SkyBelowTheModelsRoofIsWorseThanAnObstacleAboveIt) {
  const SkyTable table(ClearSky(), {});
  // The model's skyline 12 rows too low: something hides the sky above it, as trees do. 12 rows too
  // high: there is sky where a building should be.
  EXPECT_GT(table.LogRatio(3, kHorizon + 12), table.LogRatio(3, kHorizon - 12));
}

TEST(SkyTable, LikelihoodsOfABoundaryAnywhereAverageToOne) {
  // Without evidence every height of the model's skyline is as good as chance.
  const SkyTable table(cv::Mat::zeros(kRows, kColumns, CV_32F), {});
  for (int row = 5; row <= kRows - 5; ++row) {
    // The two-sided exponential is cut off at the picture's border.
    EXPECT_NEAR(table.LogRatio(0, static_cast<float>(row)), 0.0, 0.02);
  }
}

TEST(SkyTable, RowsOutsideAreThoseOfTheBorder) {
  const SkyTable table(ClearSky(), {});
  EXPECT_EQ(table.LogRatio(0, -10.0f), table.LogRatio(0, 0.0f));
  EXPECT_EQ(table.LogRatio(0, 1000.0f), table.LogRatio(0, static_cast<float>(kRows)));
  EXPECT_TRUE(std::isfinite(table.LogRatio(0, static_cast<float>(kRows))));
}

TEST(SkylineRows, ALevelHorizonIsTheMiddleRow) {
  const PinholeCamera camera{kColumns, kRows, 50.0, 50.0, 20.0, 30.0};
  std::vector<Eigen::Vector3f> directions;
  for (int i = -80; i <= 80; ++i) {
    const float azimuth = 0.01f * static_cast<float>(i);
    directions.emplace_back(std::sin(azimuth), std::cos(azimuth), 0.0f);
  }
  std::vector<float> rows(kColumns);
  SkylineRows(directions, camera,
              CamFromWorld(ViewAngles{}).toRotationMatrix().cast<float>(), rows);
  for (const float row : rows) EXPECT_NEAR(row, 30.0f, 1e-4f);
}

TEST(SkylineRows, ColumnsWithoutDirectionsAreUnknown) {
  const PinholeCamera camera{kColumns, kRows, 50.0, 50.0, 20.0, 30.0};
  const std::vector<Eigen::Vector3f> directions = {{-0.05f, 1.0f, 0.0f}, {0.0f, 1.0f, 0.0f}};
  std::vector<float> rows(kColumns);
  SkylineRows(directions, camera,
              CamFromWorld(ViewAngles{}).toRotationMatrix().cast<float>(), rows);
  EXPECT_TRUE(std::isnan(rows.front()));
  EXPECT_TRUE(std::isnan(rows.back()));
  EXPECT_FALSE(std::isnan(rows[19]));
  EXPECT_EQ(SkyLogRatio(SkyTable(ClearSky(), {}), std::vector<float>(kColumns, NAN)), 0.0);
}

TEST(SkylineRows, PassingOverWhatIsBesideThePictureChangesNothing) {
  const PinholeCamera camera{kColumns, kRows, 30.0, 30.0, 20.0, 30.0};
  Random random(HashText("SkylineRows"), 0);
  for (int trial = 0; trial < 300; ++trial) {
    // A sector or the whole circle from anywhere on, rough.
    const double first = random.Uniform(-7.0, 7.0);
    const double step = random.Uniform(0.005, 0.05);
    const double width = trial % 3 == 0 ? random.Uniform(0.2, 6.0) : 6.2831853;
    std::vector<Eigen::Vector3f> directions;
    for (int i = 0; i * step < width; ++i) {
      const double azimuth = first + i * step;
      const double elevation = random.Uniform(0.0, 0.4);
      directions.push_back(Eigen::Vector3d(std::sin(azimuth) * std::cos(elevation),
                                           std::cos(azimuth) * std::cos(elevation),
                                           std::sin(elevation))
                               .cast<float>());
    }
    const ViewAngles angles{random.Uniform(0.0, 360.0),
                            random.Uniform(-40.0, 85.0),
                            random.Uniform(-30.0, 30.0)};
    const Eigen::Matrix3f rotation = CamFromWorld(angles).toRotationMatrix().cast<float>();
    std::vector<float> all(kColumns);
    std::vector<float> in_view(kColumns);
    SkylineRows(directions, camera, rotation, all);
    SkylineRows(directions, first, step, camera, rotation, in_view);
    for (int c = 0; c < kColumns; ++c) {
      if (std::isnan(all[c])) {
        EXPECT_TRUE(std::isnan(in_view[c])) << trial << ", column " << c;
      } else {
        EXPECT_EQ(all[c], in_view[c]) << trial << ", column " << c;
      }
    }
  }
}

}  // namespace
}  // namespace ridgeline
