// SPDX-License-Identifier: Apache-2.0
#include "lines/angle_to_direction.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "base/random.h"
#include "camera/pose.h"

namespace ridgeline {
namespace {

const PinholeCamera kCamera{960, 720, 800.0, 800.0, 480.0, 360.0};

TEST(AngleToDirection, ImagesOfTheDirectionHaveNoAngle) {
  const Eigen::Quaterniond cam_from_world = CamFromWorld(ViewAngles{20.0, 8.0, -3.0});
  Random random(1, HashText("AngleToDirection"));
  const Eigen::Vector3d directions[] = {Eigen::Vector3d::UnitZ(),
                                        Eigen::Vector3d(0.9, 0.4, 0.0).normalized(),
                                        Eigen::Vector3d(-0.5, 0.8, 0.1).normalized()};
  for (const Eigen::Vector3d& direction : directions) {
    const Eigen::Vector3d along = cam_from_world * direction;
    for (int i = 0; i < 50; ++i) {
      const Eigen::Vector3d a = random.Uniform(10, 40) *
                                kCamera.RayFromImage({random.Uniform(0, 960), random.Uniform(0, 720)});
      const Eigen::Vector3d b = a + 2.0 * along;
      const LineSegment line{kCamera.ImageFromCamera(a).cast<float>(),
                             kCamera.ImageFromCamera(b).cast<float>(), 1.0f};
      if (line.Length() < 5.0f) continue;  // towards the camera: floats tell no direction
      EXPECT_NEAR(AngleToDirection(line, kCamera, along), 0.0, 1e-4);
    }
  }
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
