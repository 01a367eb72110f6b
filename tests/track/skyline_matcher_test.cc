// SPDX-License-Identifier: Apache-2.0
#include "track/skyline_matcher.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/error.h"
#include "base/random.h"
#include "score/sky_score.h"
#include "support/synthetic_city.h"
#include "track/skyline_shift.h"

namespace ridgeline {
namespace {

constexpr double kRad = std::numbers::pi / 180.0;

PinholeCamera Camera() { return {640, 480, 560.0, 560.0, 320.0, 240.0}; }

class SkylineMatcher : public ::testing::Test {
 protected:
  SkylineMatcher()
      : model_(testing::MakeCity(testing::TownHouses(5, 5, 3))),
        scene_(model_, nullptr, ProjectionOptions{}) {}

  SkylineSource Source() const {
    return [this](const Eigen::Vector3d& position, const Sector& sector) {
      return SkylineDirections(scene_.SkylineFrom(position, sector));
    };
  }

  // What a picture at this pose would show, without a picture.
  Skyline RealSkyline(const Pose& pose) const {
    const auto directions = SkylineDirections(scene_.SkylineFrom(pose.center_in_world, Sector{}));
    std::vector<float> rows(640);
    SkylineRows(directions, Camera(), pose.cam_from_world.toRotationMatrix().cast<float>(), rows);
    Skyline s;
    s.image_width = 640;
    s.image_height = 480;
    for (const float row : rows) {
      const float y = std::isnan(row) ? 0.0f : std::clamp(row, 0.0f, 480.0f);
      s.y_px.push_back(y);
      s.confidence.push_back(1.0f);
      s.columns.push_back(y > 0.0f ? SkylineColumn::kSeen : SkylineColumn::kAboveImage);
    }
    return s;
  }

  // A street of the town, looking along it and up.
  static Pose Truth(double heading_deg = 20.0) {
    return {CamFromWorld(ViewAngles{heading_deg, 8.0, 1.0}), {60.0, 90.0, 1.6}};
  }

  static Pose Turned(const Pose& pose, double heading, double pitch, double roll) {
    ViewAngles a = ViewAnglesOf(pose.cam_from_world);
    return {
        CamFromWorld(ViewAngles{a.heading_deg + heading, a.pitch_deg + pitch, a.roll_deg + roll}),
        pose.center_in_world};
  }

  SkylineMatchResult Match(const Pose& truth, const Pose& start, const std::string& method) const {
    SkylineMatchOptions options;
    options.method = method;
    options.sensor_weight_px = 0.02;
    // With three angles the position is known: surveyed, or shown by the user on a map.
    if (method != "6dof") options.position_sigma_m = 0.2;
    const SkylineL1 l1(RealSkyline(truth), Camera(), SkylineL1Options{});
    return MatchSkyline(l1, Source(), start, options);
  }

  CityModel model_;
  Scene scene_;
};

TEST_F(SkylineMatcher, ThreeAnglesAreFoundAgain) {
  const Pose truth = Truth();
  const SkylineMatchResult result = Match(truth, Turned(truth, 11.0, -1.5, 1.2), "3d");
  ASSERT_EQ(result.status, SkylineMatchStatus::kOk) << result.reason;
  EXPECT_GT(result.distance_before_px, 10.0);
  EXPECT_LT(result.distance_after_px, 1.0);
  EXPECT_LT(RotationDistanceDeg(result.pose->cam_from_world, truth.cam_from_world), 0.2);
}

TEST_F(SkylineMatcher, TwiceTwoDimensionsComeCloserThanOnce) {
  const Pose truth = Truth();
  const Pose start = Turned(truth, 9.0, 2.0, -1.0);
  const SkylineMatchResult once = Match(truth, start, "2d");
  const SkylineMatchResult twice = Match(truth, start, "2x2d");
  EXPECT_LT(RotationDistanceDeg(once.best.cam_from_world, truth.cam_from_world), 3.0);
  EXPECT_LT(RotationDistanceDeg(twice.best.cam_from_world, truth.cam_from_world), 0.3);
  EXPECT_LT(twice.distance_after_px, once.distance_after_px);
}

TEST_F(SkylineMatcher, SixDegreesCorrectThePosition) {
  const Pose truth = Truth();
  Pose start = Turned(truth, 5.0, 0.5, -0.4);
  start.center_in_world += Eigen::Vector3d(2.0, -3.0, 0.0);
  const SkylineMatchResult result = Match(truth, start, "6dof");
  ASSERT_EQ(result.status, SkylineMatchStatus::kOk) << result.reason;
  EXPECT_LT((result.pose->center_in_world - truth.center_in_world).norm(), 1.0);
  EXPECT_LT(RotationDistanceDeg(result.pose->cam_from_world, truth.cam_from_world), 0.5);
}

TEST_F(SkylineMatcher, IsTheSameEveryTime) {
  const Pose start = Turned(Truth(), 7.0, 1.0, 0.0);
  const SkylineMatchResult a = Match(Truth(), start, "3d");
  const SkylineMatchResult b = Match(Truth(), start, "3d");
  EXPECT_EQ(a.distance_after_px, b.distance_after_px);
  EXPECT_EQ(a.best.cam_from_world.coeffs(), b.best.cam_from_world.coeffs());
}

TEST_F(SkylineMatcher, APictureOfAnotherPlaceIsNotReportedAsGood) {
  int believed = 0;
  for (int i = 0; i < 8; ++i) {
    const Pose truth = Truth(45.0 * i);
    Pose start = Truth(45.0 * i + 170.0);
    start.center_in_world += Eigen::Vector3d(60.0, 30.0, 0.0);
    believed += Match(truth, start, "3d").pose.has_value();
  }
  EXPECT_LE(believed, 1);
}

TEST_F(SkylineMatcher, WithoutSkyOrModelThereIsAReasonAndNoPose) {
  const Pose truth = Truth();
  Skyline none = RealSkyline(truth);
  none.y_px.assign(640, 0.0f);
  none.columns.assign(640, SkylineColumn::kAboveImage);
  const SkylineL1 no_sky(none, Camera(), SkylineL1Options{});
  const SkylineMatchResult a = MatchSkyline(no_sky, Source(), truth, SkylineMatchOptions{});
  EXPECT_EQ(a.status, SkylineMatchStatus::kUnusable);
  EXPECT_FALSE(a.pose.has_value());
  EXPECT_EQ(a.reason, "no sky in the picture");

  Pose outside = truth;
  outside.center_in_world = {-5000.0, -5000.0, 1.6};
  const SkylineL1 l1(RealSkyline(truth), Camera(), SkylineL1Options{});
  const SkylineMatchResult b = MatchSkyline(l1, Source(), outside, SkylineMatchOptions{});
  EXPECT_EQ(b.status, SkylineMatchStatus::kNoModel);
  EXPECT_FALSE(b.pose.has_value());
}

TEST(RotationAfter, MovesTheDrawingByTheShift) {
  const PinholeCamera camera = Camera();
  const Eigen::Quaterniond before = CamFromWorld(ViewAngles{100.0, 5.0, 2.0});
  const SkylineDrawing::Motion motion{40.0, -25.0, 3.0 * kRad};
  const Eigen::Quaterniond after = RotationAfter(motion, camera, before);
  const Eigen::Vector3d axis = before.conjugate() * Eigen::Vector3d::UnitZ();
  const Eigen::Vector2d seen = camera.ImageFromCamera(after * axis);
  EXPECT_NEAR(seen.x(), camera.cx + 40.0, 1e-9);
  EXPECT_NEAR(seen.y(), camera.cy - 25.0, 1e-9);
}

TEST(RotationAfter, ATurnAloneIsExactEverywhere) {
  const PinholeCamera camera = Camera();
  const Eigen::Quaterniond before = CamFromWorld(ViewAngles{200.0, -4.0, 1.0});
  const double turn = 6.0 * kRad;
  const Eigen::Quaterniond after = RotationAfter({0.0, 0.0, turn}, camera, before);
  const Eigen::Vector3d ray = before.conjugate() * Eigen::Vector3d(0.3, -0.2, 1.0);
  const Eigen::Vector2d p = camera.ImageFromCamera(before * ray) - Eigen::Vector2d(320, 240);
  const Eigen::Vector2d q = camera.ImageFromCamera(after * ray) - Eigen::Vector2d(320, 240);
  EXPECT_NEAR(q.x(), std::cos(turn) * p.x() - std::sin(turn) * p.y(), 1e-9);
  EXPECT_NEAR(q.y(), std::sin(turn) * p.x() + std::cos(turn) * p.y(), 1e-9);
}

TEST(RotationAfterLinear, IsTheFieldOfViewPerPixel) {
  const PinholeCamera camera = Camera();
  const Eigen::Quaterniond before = CamFromWorld(ViewAngles{10.0, 0.0, 0.0});
  const ViewAngles after = ViewAnglesOf(RotationAfterLinear({64.0, 0.0, 0.0}, camera, before));
  const double fov_deg = 2.0 * std::atan(320.0 / 560.0) / kRad;
  EXPECT_NEAR(HeadingDifferenceDeg(after.heading_deg, 10.0), -fov_deg / 10.0, 1e-9);
}

TEST(SkylineMatchOptions, UnknownMethodIsNamed) {
  SkylineMatchOptions options;
  options.method = "4d";
  EXPECT_THROW(CheckOptions(options), InputError);
}

}  // namespace
}  // namespace ridgeline
