// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/random.h"
#include "projection/fast_angle.h"
#include "projection/scene.h"
#include "support/synthetic_city.h"
#include "support/synthetic_terrain.h"

namespace ridgeline {
namespace {

using testing::MakeCity;
using testing::MakeTerrain;
using testing::TownHouses;

Eigen::Vector3d Direction(double azimuth, double elevation) {
  return {std::sin(azimuth) * std::cos(elevation),
          std::cos(azimuth) * std::cos(elevation),
          std::sin(elevation)};
}

// Just below the skyline there is something, and above it nothing, ray by ray.
void ExpectSkylineSeparates(const Scene& scene, const Eigen::Vector3d& eye, const Sector& sector) {
  const VisibleSet visible = scene.SkylineFrom(eye, sector);
  ASSERT_FALSE(visible.skyline_elevation.empty());
  // A hundredth of a pixel at f = 1000 px; Embree's robust rays err less.
  const double margin = 1e-5;
  for (std::size_t k = 0; k < visible.skyline_elevation.size(); ++k) {
    const double azimuth = visible.first_azimuth + static_cast<double>(k) * visible.azimuth_step;
    const double elevation = visible.skyline_elevation[k];
    ASSERT_GE(elevation, 0.0);
    if (elevation > 0.0) {
      EXPECT_TRUE(scene.Raycast(eye, Direction(azimuth, elevation - margin)).has_value())
          << "column " << k << " at " << azimuth << " rad, " << elevation << " rad";
    }
    for (double above = elevation + margin; above < 1.5; above += 0.01) {
      EXPECT_FALSE(scene.Raycast(eye, Direction(azimuth, above)).has_value())
          << "column " << k << " at " << azimuth << " rad, " << above << " > " << elevation;
    }
  }
}

TEST(Skyline, SeparatesBuildingsFromSky) {
  const CityModel model = MakeCity(TownHouses(3, 3, 21));
  const Scene scene(model, nullptr, {});
  Random random(1, HashText("skyline"));
  for (int k = 0; k < 6; ++k) {
    const Eigen::Vector3d eye(random.Uniform(0, 180),
                              60.0 * static_cast<double>(random.Below(4)),
                              random.Uniform(1.0, 15.0));
    ExpectSkylineSeparates(scene, eye, {});
  }
}

TEST(Skyline, SeparatesHillsFromSky) {
  const CityModel model = MakeCity(TownHouses(2, 2, 22));
  const HeightGrid dtm = MakeTerrain({-200, -200}, 2.0, 256, 256, [](double x, double y) {
    return 30.0 * std::sin(x / 60.0) * std::cos(y / 45.0) - 20.0;
  });
  const Scene scene(model, &dtm, {});
  for (const Eigen::Vector3d& eye :
       {Eigen::Vector3d(60, 60, 12.0), Eigen::Vector3d(10, -90, 15), Eigen::Vector3d(0, 61, 3)}) {
    ExpectSkylineSeparates(scene, eye, {});
  }
}

TEST(Skyline, OfASectorIsPartOfTheWholeTurn) {
  const CityModel model = MakeCity(TownHouses(2, 2, 23));
  const Scene scene(model, nullptr, {});
  const Eigen::Vector3d eye(60, 60, 1.6);
  const VisibleSet whole = scene.SkylineFrom(eye, {});
  const auto turn = static_cast<int>(whole.skyline_elevation.size());
  for (const double center : {0.0, 3.1, -3.1, 6.2, 20.0}) {
    const VisibleSet part = scene.SkylineFrom(eye, {center, 0.8});
    EXPECT_NEAR(static_cast<double>(part.skyline_elevation.size()), 1.6 / part.azimuth_step, 1.0);
    for (std::size_t k = 0; k < part.skyline_elevation.size(); ++k) {
      const double azimuth = part.first_azimuth + static_cast<double>(k) * part.azimuth_step;
      const int column = static_cast<int>(std::lround(azimuth / whole.azimuth_step));
      EXPECT_EQ(part.skyline_elevation[k],
                whole.skyline_elevation[static_cast<std::size_t>((column % turn + turn) % turn)]);
    }
  }
}

TEST(Skyline, OfAWallFollowsTheClosedForm) {
  // The top edge of a wall 20 m to the north is 10 m above the eye.
  testing::House house;
  house.center = {0.0, 25.0};
  house.length_m = 10.0;
  house.width_m = 400.0;
  house.eaves_m = house.ridge_m = 11.0;
  const CityModel model = MakeCity({house});
  const Scene scene(model, nullptr, {});
  const VisibleSet visible = scene.SkylineFrom({0, 0, 1}, {0.0, 1.0});
  for (std::size_t k = 0; k < visible.skyline_elevation.size(); ++k) {
    const double azimuth = visible.first_azimuth + static_cast<double>(k) * visible.azimuth_step;
    EXPECT_NEAR(visible.skyline_elevation[k], std::atan(10.0 / 20.0 * std::cos(azimuth)), 1e-6);
  }
}

TEST(FastAngle, AgreesWithTheStandardLibrary) {
  Random random(1, HashText("angles"));
  for (int k = 0; k < 10000; ++k) {
    const auto x = static_cast<float>(random.Uniform(-10, 10));
    const auto y = static_cast<float>(random.Uniform(-10, 10));
    EXPECT_NEAR(FastAzimuth(x, y), std::atan2(x, y), 5e-7);
    EXPECT_NEAR(FastAtan(std::abs(x)), std::atan(std::abs(x)), 3e-7);
  }
  EXPECT_EQ(FastAzimuth(0, 0), 0.0f);
  EXPECT_FLOAT_EQ(FastAzimuth(0, -1), static_cast<float>(std::numbers::pi));
  EXPECT_FLOAT_EQ(FastAzimuth(-1, 0), static_cast<float>(-std::numbers::pi / 2));
}

}  // namespace
}  // namespace ridgeline
