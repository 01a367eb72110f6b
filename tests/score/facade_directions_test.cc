// SPDX-License-Identifier: Apache-2.0
#include "score/facade_directions.h"

#include <gtest/gtest.h>

#include "camera/pose.h"

namespace ridgeline {
namespace {

const PinholeCamera kCamera{400, 300, 400.0, 400.0, 200.0, 150.0};

// A model of one wall, seen in every direction.
CityModel Wall(double normal_heading_deg) {
  CityModel model;
  Surface wall;
  wall.surface_class = SurfaceClass::kWall;
  const double h = normal_heading_deg * M_PI / 180.0;
  wall.normal = Eigen::Vector3d(std::sin(h), std::cos(h), 0.0).cast<float>();
  model.surfaces = {wall};
  return model;
}

SurfacePanorama Everywhere(std::uint32_t surface) {
  SurfacePanorama panorama;
  panorama.first_azimuth = -1.5;
  panorama.first_elevation = -1.0;
  panorama.step = 0.1;
  panorama.columns = 31;
  panorama.rows = 21;
  panorama.surfaces.assign(31 * 21, surface);
  return panorama;
}

// Courses of a wall as a level camera to the north sees them.
std::vector<LineSegment> CoursesOf(double normal_heading_deg) {
  const double h = normal_heading_deg * M_PI / 180.0;
  const Eigen::Vector3d course(std::cos(h), -std::sin(h), 0.0);
  const Eigen::Quaterniond q = CamFromWorld(ViewAngles{});
  std::vector<LineSegment> segments;
  for (const double height : {-2.0, -1.0, 1.0, 2.0, 3.0}) {
    const Eigen::Vector3d middle(0.5, 10.0, height);
    segments.push_back({kCamera.ImageFromCamera(q * (middle - 2.0 * course)).cast<float>(),
                        kCamera.ImageFromCamera(q * (middle + 2.0 * course)).cast<float>(), 1.0f});
  }
  return segments;
}

double RatioOf(double wall_heading_deg, double line_heading_deg, std::uint32_t surface = 0) {
  const FacadeDirections cue(CoursesOf(line_heading_deg), kCamera, {});
  return cue.LogRatio(Everywhere(surface), Wall(wall_heading_deg),
                      CamFromWorld(ViewAngles{}).toRotationMatrix().cast<float>());
}

TEST(FacadeDirections, LinesAlongTheWallSpeakForItAndOthersAgainst) {
  EXPECT_GT(RatioOf(150.0, 150.0), 0.0);
  EXPECT_LT(RatioOf(120.0, 150.0), 0.0);
}

TEST(FacadeDirections, FallsWithTheAngleBetweenLinesAndWall) {
  double last = RatioOf(150.0, 150.0);
  for (const double off : {2.0, 5.0, 10.0}) {
    const double ratio = RatioOf(150.0 + off, 150.0);
    EXPECT_LT(ratio, last);
    last = ratio;
  }
}

TEST(FacadeDirections, SkyAndGroundSayNothing) {
  EXPECT_EQ(RatioOf(150.0, 150.0, kNoSurface), 0.0);
  EXPECT_EQ(RatioOf(150.0, 150.0, kTerrainSurface), 0.0);
}

TEST(FacadeDirections, NoLinesSayNothing) {
  const FacadeDirections cue({}, kCamera, {});
  EXPECT_EQ(cue.LogRatio(Everywhere(0), Wall(150.0), Eigen::Matrix3f::Identity()), 0.0f);
}

TEST(SurfacePanorama, FindsTheNearestRayAndNothingOutside) {
  SurfacePanorama panorama = Everywhere(0);
  panorama.surfaces[10 * 31 + 15] = 7;  // azimuth 0, elevation 0
  EXPECT_EQ(*panorama.Find({0.0f, 1.0f, 0.0f}), 7u);
  EXPECT_EQ(*panorama.Find({0.04f, 1.0f, 0.04f}), 7u);
  EXPECT_EQ(*panorama.Find({0.06f, 1.0f, 0.0f}), 0u);
  EXPECT_EQ(panorama.Find({0.0f, -1.0f, 0.0f}), nullptr);
  EXPECT_EQ(panorama.Find({0.0f, 0.1f, 1.0f}), nullptr);
}

}  // namespace
}  // namespace ridgeline
