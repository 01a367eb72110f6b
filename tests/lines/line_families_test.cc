// SPDX-License-Identifier: Apache-2.0
#include "lines/line_families.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "base/random.h"
#include "camera/pose.h"

namespace ridgeline {
namespace {

const PinholeCamera kCamera{960, 720, 800.0, 800.0, 480.0, 360.0};
const Eigen::Quaterniond kCamFromWorld = CamFromWorld(ViewAngles{20.0, 8.0, -3.0});

// Images of `count` lines of a world direction at random places before the camera.
void Add(const Eigen::Vector3d& direction, int count, Random& random,
         std::vector<LineSegment>& segments) {
  const Eigen::Vector3d along = kCamFromWorld * direction;
  for (int i = 0; i < count; ++i) {
    const double depth = random.Uniform(10, 40);
    const Eigen::Vector3d a =
        depth * kCamera.RayFromImage({random.Uniform(0, 960), random.Uniform(0, 300)});
    const Eigen::Vector3d b = a + 2.0 * along;
    segments.push_back({kCamera.ImageFromCamera(a).cast<float>(),
                        kCamera.ImageFromCamera(b).cast<float>(), 1.0f});
  }
}

Eigen::Vector3d Horizontal(double heading_deg) {
  const double h = heading_deg * std::numbers::pi / 180.0;
  return {std::sin(h), std::cos(h), 0.0};
}

TEST(LineFamilies, FindsTheVerticalAndTwoHorizontalFamilies) {
  Random random(1, HashText("LineFamilies"));
  std::vector<LineSegment> segments;
  Add(Eigen::Vector3d::UnitZ(), 30, random, segments);
  Add(Horizontal(65.0), 40, random, segments);
  Add(Horizontal(-35.0), 25, random, segments);
  const Eigen::Vector3d up = kCamFromWorld * Eigen::Vector3d::UnitZ();
  const LineFamilies families = FindLineFamilies(segments, kCamera, up, {});
  ASSERT_GE(families.directions.size(), 3u);
  EXPECT_GT(std::abs(families.directions[1].dot(kCamFromWorld * Horizontal(65.0))), 0.9995);
  EXPECT_GT(std::abs(families.directions[2].dot(kCamFromWorld * Horizontal(-35.0))), 0.9995);
  int right = 0;
  for (int i = 0; i < 95; ++i) {
    right += families.family_of_line[i] == (i < 30 ? 0 : i < 70 ? 1 : 2) ? 1 : 0;
  }
  EXPECT_GE(right, 88);  // a line towards two vanishing points may be either's
  for (int i = 0; i < 30; ++i) EXPECT_EQ(families.family_of_line[i], LineFamilies::kVertical);
}

TEST(LineFamilies, LinesAtRandomHaveFewFamilies) {
  Random random(1, HashText("LineFamiliesRandom"));
  std::vector<LineSegment> segments;
  for (int i = 0; i < 400; ++i) {
    const Eigen::Vector2f a(random.Uniform(0, 960), random.Uniform(0, 720));
    const double turn = random.Uniform(0, 2.0 * std::numbers::pi);
    segments.push_back({a, a + Eigen::Vector2f(40 * std::cos(turn), 40 * std::sin(turn)), 1.0f});
  }
  const Eigen::Vector3d up = kCamFromWorld * Eigen::Vector3d::UnitZ();
  LineFamilyOptions options;
  options.min_share = 0.1;
  const LineFamilies families = FindLineFamilies(segments, kCamera, up, options);
  EXPECT_EQ(families.directions.size(), 1u);
}

TEST(LineFamilies, WithoutLinesThereIsTheVerticalAlone) {
  const LineFamilies families = FindLineFamilies({}, kCamera, -Eigen::Vector3d::UnitY(), {});
  EXPECT_EQ(families.directions.size(), 1u);
  EXPECT_TRUE(families.family_of_line.empty());
}

TEST(AngleToDirection, IsThatBetweenLineAndVanishingPoint) {
  // A level camera: verticals are vertical in the picture.
  const Eigen::Vector3d up = -Eigen::Vector3d::UnitY();
  for (const double deg : {-60.0, -3.0, 0.0, 1.0, 89.0}) {
    const double rad = deg * std::numbers::pi / 180.0;
    const Eigen::Vector2f a(300.0f, 200.0f);
    const Eigen::Vector2f d(std::sin(rad) * 50.0, -std::cos(rad) * 50.0);
    EXPECT_NEAR(AngleToDirection({a, a + d, 1.0f}, kCamera, up), rad, 1e-5);
    EXPECT_NEAR(AngleToDirection({a + d, a, 1.0f}, kCamera, up), rad, 1e-5);
  }
}

}  // namespace
}  // namespace ridgeline
