// SPDX-License-Identifier: Apache-2.0
// What may not matter to a pose: how the world is turned, and in which order its buildings come.
#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "eval/metrics.h"
#include "localize/localizer.h"
#include "support/synthetic_city.h"

namespace ridgeline {
namespace {

using testing::House;

const PinholeCamera kCamera{640, 480, 500.0, 500.0, 320.0, 240.0};
const Eigen::Vector3d kOrigin(690000.0, 5335000.0, 500.0);

std::vector<House> Street() {
  std::vector<House> houses;
  const double eaves[] = {6.0, 9.0, 5.0, 8.0, 11.0, 7.0, 6.5, 10.0};
  for (int i = 0; i < 8; ++i) {
    House house;
    house.center = {i % 2 == 0 ? -11.0 : 12.0, 8.0 + 9.0 * i};
    house.length_m = 9.0 + i % 3;
    house.eaves_m = eaves[i];
    house.ridge_m = eaves[i] + (i % 3 == 0 ? 0.0 : 3.0);
    houses.push_back(house);
  }
  return houses;
}

CityModel ModelOf(const std::vector<House>& houses) {
  CityModel model = testing::MakeCity(houses);
  model.crs.horizontal_epsg = 25832;
  model.origin_in_world = kOrigin;
  return model;
}

// Sky white, ground dark, walls and roofs by their direction.
cv::Mat Photo(const Scene& scene, const Pose& cam_from_local) {
  const ViewBuffers buffers = scene.Render(kCamera, cam_from_local);
  cv::Mat picture(kCamera.height, kCamera.width, CV_8UC3, cv::Scalar(245, 240, 235));
  for (int y = 0; y < picture.rows; ++y) {
    for (int x = 0; x < picture.cols; ++x) {
      const std::uint32_t index = buffers.surfaces[static_cast<std::size_t>(y) * picture.cols + x];
      if (index == kNoSurface) {
        if (y > picture.rows * 6 / 10) picture.at<cv::Vec3b>(y, x) = {70, 70, 70};
        continue;
      }
      const Surface& surface = scene.model().surfaces[index];
      const auto shade = static_cast<unsigned char>(110.0 + 50.0 * surface.normal.x() +
                                                    25.0 * surface.normal.y());
      const bool is_roof = surface.surface_class == SurfaceClass::kRoof;
      picture.at<cv::Vec3b>(y, x) =
          is_roof ? cv::Vec3b(60, 80, shade) : cv::Vec3b(shade, shade, shade);
    }
  }
  return picture;
}

LocalizerOptions Options() {
  LocalizerOptions options;
  options.search.space.east_m = 5.0;
  options.search.space.north_m = 5.0;
  return options;
}

class WorldProperties : public ::testing::Test {
 protected:
  WorldProperties() : model_(ModelOf(Street())), localizer_(model_, std::nullopt, Options()) {
    Pose place;
    place.cam_from_world = CamFromWorld(ViewAngles{4.0, 3.0, 0.0});
    place.center_in_world = {0.5, -6.0, 1.7};
    input_.picture = Photo(localizer_.scene(), place);
    input_.camera = {"PINHOLE", 640, 480, {500.0, 500.0, 320.0, 240.0}};
    input_.prior.position_in_world = kOrigin.head<2>() + Eigen::Vector2d(3.5, -8.5);
    input_.prior.height_in_world = kOrigin.z() + 1.7;
    input_.prior.heading_deg = 352.0;
    input_.prior.pitch_deg = 3.0;
    input_.prior.roll_deg = 0.0;
  }

  CityModel model_;
  Localizer localizer_;
  LocalizationInput input_;
};

TEST_F(WorldProperties, TheOrderOfBuildingsDoesNotMatter) {
  std::vector<House> houses = Street();
  std::reverse(houses.begin(), houses.end());
  std::rotate(houses.begin(), houses.begin() + 3, houses.end());
  const CityModel model = ModelOf(houses);
  const Localizer localizer(model, std::nullopt, Options());
  const Localization here = localizer_.Localize(input_, 1, 0);
  const Localization there = localizer.Localize(input_, 1, 0);
  ASSERT_TRUE(here.pose && there.pose);
  const PoseError error = ErrorOf(*there.pose, *here.pose);
  EXPECT_LT(error.translation_m, 1e-3);
  EXPECT_LT(error.rotation_deg, 1e-3);
}

// East becomes south, north east.
TEST_F(WorldProperties, APoseTurnsWithTheWorld) {
  Eigen::Matrix2d turn;
  turn << 0.0, 1.0, -1.0, 0.0;
  std::vector<House> houses = Street();
  for (House& house : houses) {
    house.center = turn * house.center;
    house.heading_deg += 90.0;
  }
  const CityModel model = ModelOf(houses);
  const Localizer localizer(model, std::nullopt, Options());
  LocalizationInput input = input_;
  input.prior.position_in_world =
      kOrigin.head<2>() + turn * (input_.prior.position_in_world - kOrigin.head<2>());
  input.prior.heading_deg = WrapHeadingDeg(*input_.prior.heading_deg + 90.0);
  const Localization here = localizer_.Localize(input_, 1, 0);
  const Localization there = localizer.Localize(input, 1, 0);
  ASSERT_TRUE(here.pose && there.pose);
  Eigen::Matrix3d turn_in_space = Eigen::Matrix3d::Identity();
  turn_in_space.topLeftCorner<2, 2>() = turn;
  const Pose expected{here.pose->cam_from_world * Eigen::Quaterniond(turn_in_space).conjugate(),
                      kOrigin + turn_in_space * (here.pose->center_in_world - kOrigin)};
  const PoseError error = ErrorOf(*there.pose, expected);
  EXPECT_LT(error.translation_m, 1e-3);
  EXPECT_LT(error.rotation_deg, 1e-3);
}

}  // namespace
}  // namespace ridgeline
