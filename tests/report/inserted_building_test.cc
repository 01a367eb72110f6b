// SPDX-License-Identifier: Apache-2.0
#include "report/inserted_building.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "support/synthetic_city.h"

namespace ridgeline {
namespace {

constexpr double kFocalPx = 300.0;

PinholeCamera Camera() { return {320, 240, kFocalPx, kFocalPx, 160.0, 120.0}; }

// At eye height, looking level to the north.
Pose Viewer() { return {CamFromWorld(ViewAngles{0.0, 0.0, 0.0}), {0.0, 0.0, 1.6}}; }

// A box 10 m wide and 8 m high, its front 46 m north of the viewer.
CityModel Box() { return testing::MakeCity({{{0.0, 50.0}, 8.0, 10.0, 0.0, 0.0, 8.0, 8.0}}); }

// Share of the picture that the box's front fills.
double FrontShare() { return (10.0 * kFocalPx / 46.0) * (8.0 * kFocalPx / 46.0) / (320.0 * 240.0); }

InsertedPicture Insert(const CityModel& city_model, double opacity = 1.0) {
  const CityModel box = Box();
  const Scene city(city_model, nullptr, ProjectionOptions{});
  const Scene building(box, nullptr, ProjectionOptions{});
  InsertOptions options;
  options.opacity = opacity;
  return InsertBuilding(cv::Mat(240, 320, CV_8UC3, cv::Scalar(10, 20, 250)),
                        city,
                        building,
                        Camera(),
                        Viewer(),
                        options);
}

// A house behind the viewer: it hides nothing.
const testing::House kBehind{{0.0, -40.0}, 8.0, 10.0, 0.0, 0.0, 6.0, 6.0};

TEST(InsertBuilding, FillsItsOutlineAndNothingElse) {
  const InsertedPicture result = Insert(testing::MakeCity({kBehind}));
  // A pixel's width around the outline.
  EXPECT_NEAR(result.visible_share, FrontShare(), 0.05 * FrontShare());
  EXPECT_EQ(result.hidden_share, 0.0);
  int changed = 0;
  for (int y = 0; y < 240; ++y) {
    for (int x = 0; x < 320; ++x) {
      changed += result.picture.at<cv::Vec3b>(y, x) != cv::Vec3b(10, 20, 250);
    }
  }
  EXPECT_NEAR(changed / (320.0 * 240.0), FrontShare(), 0.05 * FrontShare());
  EXPECT_NE(result.picture.at<cv::Vec3b>(110, 160), cv::Vec3b(10, 20, 250));
}

TEST(InsertBuilding, IsHiddenByWhatStandsBeforeIt) {
  const InsertedPicture all =
      Insert(testing::MakeCity({{{0.0, 25.0}, 6.0, 60.0, 0.0, 0.0, 12.0, 12.0}}));
  EXPECT_EQ(all.visible_share, 0.0);
  EXPECT_EQ(all.hidden_share, 1.0);
  EXPECT_EQ(all.picture.at<cv::Vec3b>(110, 160), cv::Vec3b(10, 20, 250));

  // A house whose west side is in the line of sight to the middle: the east half is hidden.
  const InsertedPicture half =
      Insert(testing::MakeCity({{{20.0, 25.0}, 6.0, 40.0, 0.0, 0.0, 12.0, 12.0}}));
  EXPECT_NEAR(half.hidden_share, 0.5, 0.03);
  EXPECT_NEAR(half.visible_share, 0.5 * FrontShare(), 0.05 * FrontShare());
}

TEST(InsertBuilding, DoesNotHideWhatStandsBeforeItsOwnPlace) {
  const InsertedPicture result =
      Insert(testing::MakeCity({{{0.0, 90.0}, 6.0, 60.0, 0.0, 0.0, 30.0, 30.0}}));
  EXPECT_EQ(result.hidden_share, 0.0);
}

TEST(InsertBuilding, OpacityMixesWithThePhoto) {
  const cv::Vec3b solid = Insert(testing::MakeCity({kBehind})).picture.at<cv::Vec3b>(110, 160);
  const cv::Vec3b half = Insert(testing::MakeCity({kBehind}), 0.5).picture.at<cv::Vec3b>(110, 160);
  const cv::Vec3b photo(10, 20, 250);
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(half[c], 0.5 * (solid[c] + photo[c]), 2.0);
}

TEST(PlacedModel, StandsOnItsBaseTurnedAndScaled) {
  const CityModel placed = PlacedModel(Box(), {100.0, 200.0, 7.0}, 90.0, 2.0);
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d& v : placed.vertices) box.extend(v);
  EXPECT_NEAR((box.min() - Eigen::Vector3d(92.0, 190.0, 7.0)).norm(), 0.0, 1e-6);
  EXPECT_NEAR((box.max() - Eigen::Vector3d(108.0, 210.0, 23.0)).norm(), 0.0, 1e-6);
}

}  // namespace
}  // namespace ridgeline
