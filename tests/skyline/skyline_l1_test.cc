// SPDX-License-Identifier: Apache-2.0
#include "score/skyline_l1.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "camera/pose.h"

namespace ridgeline {
namespace {

constexpr double kRad = std::numbers::pi / 180.0;

PinholeCamera Camera() { return {640, 480, 600.0, 600.0, 320.0, 240.0}; }

Skyline Flat(float y, SkylineColumn column = SkylineColumn::kSeen) {
  Skyline s;
  s.image_width = 640;
  s.image_height = 480;
  s.column_step_px = 1.0;
  s.y_px.assign(640, y);
  s.confidence.assign(640, column == SkylineColumn::kUnknown ? 0.0f : 1.0f);
  s.columns.assign(640, column);
  return s;
}

std::vector<float> Rows(const SkylineL1& l1, double y_px) {
  return std::vector<float>(l1.rows().size(),
                            static_cast<float>(y_px * l1.camera().height / 480.0));
}

TEST(SkylineL1, IsTheMeanDistanceInPixelsAt640) {
  SkylineL1Options options;
  options.robust = false;
  const SkylineL1 l1(Flat(200.0f), Camera(), options);
  EXPECT_NEAR(l1.DistanceOfRows(Rows(l1, 200.0)), 0.0, 1e-3);
  EXPECT_NEAR(l1.DistanceOfRows(Rows(l1, 230.0)), 30.0, 1e-3);
  std::vector<float> half = Rows(l1, 200.0);
  for (std::size_t c = 0; c < half.size() / 2; ++c) half[c] += 10.0f;  // 20 px at 640
  EXPECT_NEAR(l1.DistanceOfRows(half), 10.0, 1e-3);
}

TEST(SkylineL1, DoesNotDependOnTheResolution) {
  Skyline large = Flat(800.0f);
  large.image_width = 2560;
  large.image_height = 1920;
  large.column_step_px = 4.0;
  const SkylineL1 l1(large, {2560, 1920, 2400.0, 2400.0, 1280.0, 960.0}, SkylineL1Options{});
  EXPECT_NEAR(l1.DistanceOfRows(Rows(l1, 190.0)), 10.0, 1e-3);
}

TEST(SkylineL1, RobustLimitsObstructedColumnsMoreThanMissingRoofs) {
  SkylineL1Options options;
  const SkylineL1 l1(Flat(200.0f), Camera(), options);
  // Virtual below the real one: something hides the sky.
  EXPECT_NEAR(l1.DistanceOfRows(Rows(l1, 400.0)), options.max_obstructed_px, 1e-3);
  // Virtual above the real one: sky where a building should be.
  EXPECT_NEAR(l1.DistanceOfRows(Rows(l1, 10.0)), options.max_deviation_px, 1e-3);
}

TEST(SkylineL1, AgreesWhereBothAreAboveThePicture) {
  const SkylineL1 l1(Flat(0.0f, SkylineColumn::kAboveImage), Camera(), SkylineL1Options{});
  EXPECT_NEAR(l1.DistanceOfRows(Rows(l1, -300.0)), 0.0, 1e-6);
  EXPECT_GT(l1.DistanceOfRows(Rows(l1, 50.0)), 10.0);
}

TEST(SkylineL1, IgnoresUnknownColumns) {
  Skyline skyline = Flat(200.0f);
  for (std::size_t c = 0; c < 300; ++c) {
    skyline.y_px[c] = 20.0f;
    skyline.columns[c] = SkylineColumn::kUnknown;
    skyline.confidence[c] = 0.0f;
  }
  const SkylineL1 l1(skyline, Camera(), SkylineL1Options{});
  EXPECT_NEAR(l1.DistanceOfRows(Rows(l1, 200.0)), 0.0, 1e-3);
}

TEST(SkylineL1, PicturesWithoutSkyHaveAReasonAndTheWorstEnergy) {
  const SkylineL1 none(Flat(0.0f, SkylineColumn::kAboveImage), Camera(), SkylineL1Options{});
  EXPECT_EQ(none.use(), SkylineUse::kNoSky);
  EXPECT_EQ(none.Energy(0.0), 1.0);
  EXPECT_STREQ(ReasonOf(none.use()), "no sky in the picture");
  Skyline few = Flat(0.0f, SkylineColumn::kUnknown);
  for (std::size_t c = 0; c < 20; ++c) few.columns[c] = SkylineColumn::kSeen;
  EXPECT_EQ(SkylineL1(few, Camera(), SkylineL1Options{}).use(), SkylineUse::kTooFewKnown);
}

TEST(SkylineL1, EnergyIsOneHalfAtItsScale) {
  const SkylineL1 l1(Flat(200.0f), Camera(), SkylineL1Options{});
  EXPECT_EQ(l1.Energy(0.0), 0.0);
  EXPECT_NEAR(l1.Energy(SkylineL1Options{}.half_energy_px), 0.5, 1e-12);
}

TEST(SkylineDirections, GiveAzimuthAndElevation) {
  VisibleSet visible;
  visible.first_azimuth = 30.0 * kRad;
  visible.azimuth_step = 60.0 * kRad;
  visible.skyline_elevation = {0.0f, static_cast<float>(45.0 * kRad)};
  const auto directions = SkylineDirections(visible);
  EXPECT_LT((directions[0] - Eigen::Vector3f(0.5f, std::sqrt(0.75f), 0.0f)).norm(), 1e-6);
  EXPECT_LT((directions[1] - Eigen::Vector3f(std::sqrt(0.5f), 0.0f, std::sqrt(0.5f))).norm(), 1e-6);
}

// A wall at 45 degrees elevation all around, seen by a level camera, is a hyperbola:
// y = cy - f * sqrt(1 + ((x - cx) / f)^2) * tan(elevation).
TEST(SkylineL1, ProjectsDirectionsAsACameraDoes) {
  const double elevation = 15.0 * kRad;
  VisibleSet visible;
  visible.azimuth_step = 2.0 * std::numbers::pi / 3600;
  visible.skyline_elevation.assign(3600, static_cast<float>(elevation));
  const PinholeCamera camera = Camera();
  Skyline skyline = Flat(0.0f);
  for (std::size_t c = 0; c < skyline.size(); ++c) {
    const double u = (skyline.XOf(c) - camera.cx) / camera.fx;
    skyline.y_px[c] =
        static_cast<float>(camera.cy - camera.fy * std::hypot(1.0, u) * std::tan(elevation));
  }
  SkylineL1Options options;
  options.precision_px = 0.0;
  options.columns = 640;
  const SkylineL1 l1(skyline, camera, options);
  const Eigen::Matrix3f rotation =
      CamFromWorld(ViewAngles{77.0, 0.0, 0.0}).toRotationMatrix().cast<float>();
  EXPECT_LT(l1.Distance(SkylineDirections(visible), rotation), 0.01);
}

}  // namespace
}  // namespace ridgeline
