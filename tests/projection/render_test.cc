// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/core.hpp>
#include <optional>

#include "base/error.h"
#include "base/random.h"
#include "camera/pose.h"
#include "projection/rasterizer.h"
#include "projection/scene.h"
#include "projection/surface_panorama.h"
#include "projection/zbuffer_hough.h"
#include "support/synthetic_city.h"
#include "support/synthetic_terrain.h"

namespace ridgeline {
namespace {

using testing::House;
using testing::MakeCity;
using testing::MakeTerrain;
using testing::TownHouses;

constexpr PinholeCamera kCamera{320, 240, 260.0, 250.0, 158.0, 121.0};

Pose PoseAt(const Eigen::Vector3d& center, const ViewAngles& angles) {
  return {CamFromWorld(angles), center};
}

// A box 10 m wide and 8 m high whose front lies 20 m to the north.
CityModel OneBox() {
  House house;
  house.center = {0.0, 24.0};
  house.length_m = 8.0;
  house.width_m = 10.0;
  house.eaves_m = house.ridge_m = 8.0;
  return MakeCity({house});
}

TEST(Render, DepthSurfaceAndNormalOfABox) {
  const CityModel model = OneBox();
  const Scene scene(model, nullptr, {});
  const ViewBuffers buffers = scene.Render(kCamera, PoseAt({0, 0, 2}, {}), true);
  const int row = 120;
  const int column = 158;
  EXPECT_NEAR(buffers.depth.at<float>(row, column), 20.0f, 1e-4f);
  const std::uint32_t surface = buffers.surfaces[row * 320 + column];
  ASSERT_LT(surface, model.surfaces.size());
  EXPECT_EQ(model.surfaces[surface].surface_class, SurfaceClass::kWall);
  EXPECT_NEAR(model.surfaces[surface].normal.y(), -1.0f, 1e-6f);
  EXPECT_NEAR(buffers.normals.at<cv::Vec3f>(row, column)[1], -1.0f, 1e-6f);
  // The wall's upper left corner is at (-5, 20, 8): columns from 158 - 65 = 93, rows from
  // 121 - 75 = 46 on.
  EXPECT_TRUE(std::isinf(buffers.depth.at<float>(45, 150)));
  EXPECT_FALSE(std::isinf(buffers.depth.at<float>(46, 150)));
  EXPECT_TRUE(std::isinf(buffers.depth.at<float>(100, 92)));
  EXPECT_FALSE(std::isinf(buffers.depth.at<float>(100, 93)));
  EXPECT_EQ(buffers.surfaces[0], kNoSurface);
}

TEST(Render, TerrainIsHitAndNamed) {
  const CityModel model = OneBox();
  const HeightGrid dtm =
      MakeTerrain({-100, -100}, 1.0, 201, 201, [](double, double) { return 0.0; });
  const Scene scene(model, &dtm, {});
  const ViewBuffers buffers = scene.Render(kCamera, PoseAt({0, 0, 2}, {}), true);
  // 2 m below the eye, row 221.5 looks down 100.5 / 250: the ground is 4.975 m away.
  EXPECT_EQ(buffers.surfaces[221 * 320 + 100], kTerrainSurface);
  EXPECT_NEAR(buffers.depth.at<float>(221, 100), 2.0 * 250.0 / 100.5, 1e-4);
  EXPECT_NEAR(buffers.normals.at<cv::Vec3f>(221, 100)[2], 1.0f, 1e-6f);
}

TEST(SurfacePanorama, AgreesWithSingleRays) {
  const CityModel model = MakeCity(TownHouses(2, 2, 32));
  const Scene scene(model, nullptr, {});
  const Eigen::Vector3d eye(60, 60, 2);
  const PanoramaRange range{{3.0, 0.7, -0.3, 0.5}, 0.03};
  const SurfacePanorama panorama = SurfacesFrom(scene, eye, range);
  ASSERT_EQ(panorama.surfaces.size(), static_cast<std::size_t>(panorama.columns) * panorama.rows);
  std::size_t i = 0;
  std::size_t wrong = 0;
  for (int row = 0; row < panorama.rows; ++row) {
    for (int column = 0; column < panorama.columns; ++column, ++i) {
      const double azimuth = panorama.first_azimuth + column * panorama.step;
      const double elevation = panorama.first_elevation + row * panorama.step;
      const Eigen::Vector3d direction(std::sin(azimuth) * std::cos(elevation),
                                      std::cos(azimuth) * std::cos(elevation),
                                      std::sin(elevation));
      const std::optional<double> distance = scene.Raycast(eye, direction);
      if ((panorama.surfaces[i] != kNoSurface) != distance.has_value()) {
        ++wrong;
        continue;
      }
      EXPECT_EQ(panorama.Find(direction.cast<float>()), &panorama.surfaces[i]);
      if (!distance) continue;
      const Eigen::Vector3d normal = model.surfaces[panorama.surfaces[i]].normal.cast<double>();
      EXPECT_LT(normal.dot(direction), 0.0) << "the faces of closed houses are seen from outside";
    }
  }
  // Between four rays that see the same there may be something thin.
  EXPECT_LT(wrong, panorama.surfaces.size() / 500);
  EXPECT_EQ(panorama.Find({0.0f, 1.0f, 0.0f}), nullptr) << "behind";
}

// A wall that fills more than four steps is seen by exactly the rays that a cast of each would find.
TEST(SurfacePanorama, WideSurfacesAreExact) {
  const CityModel model = OneBox();
  const Scene scene(model, nullptr, {});
  const Eigen::Vector3d eye(1.0, -2.0, 3.0);
  for (const double center : {0.0, 0.4, -0.5}) {
    const SurfacePanorama panorama = SurfacesFrom(scene, eye, {{center, 0.9, -0.5, 0.6}, 0.01});
    std::vector<Eigen::Vector3f> directions;
    for (int row = 0; row < panorama.rows; ++row) {
      const double elevation = panorama.first_elevation + row * panorama.step;
      for (int column = 0; column < panorama.columns; ++column) {
        const double azimuth = panorama.first_azimuth + column * panorama.step;
        directions.emplace_back(std::cos(elevation) * std::sin(azimuth),
                                std::cos(elevation) * std::cos(azimuth), std::sin(elevation));
      }
    }
    const std::vector<std::uint32_t> expected = scene.SurfacesAlong(eye, directions);
    std::size_t wrong = 0;  // by rounding, at the borders
    for (std::size_t i = 0; i < expected.size(); ++i) wrong += panorama.surfaces[i] != expected[i];
    EXPECT_LE(wrong, expected.size() / 2000);
  }
}

TEST(Rasterizer, AgreesWithRays) {
  const CityModel model = MakeCity(TownHouses(3, 3, 31));
  const Scene scene(model, nullptr, {});
  Random random(1, HashText("rasterizer"));
  for (int k = 0; k < 8; ++k) {
    const ViewAngles angles{
        random.Uniform(0, 360), random.Uniform(-20, 20), random.Uniform(-10, 10)};
    const Pose pose = PoseAt({random.Uniform(0, 180), 60.0 * random.Below(4), 2.0}, angles);
    const cv::Mat depth = RasterizeDepth(model, kCamera, pose, 1e4);
    const ViewBuffers rays = scene.Render(kCamera, pose);
    int different = 0;
    for (int row = 0; row < depth.rows; ++row) {
      for (int column = 0; column < depth.cols; ++column) {
        const float a = depth.at<float>(row, column);
        const float b = rays.depth.at<float>(row, column);
        if (std::isinf(a) != std::isinf(b) || std::abs(a - b) > 1e-3f * b) ++different;
      }
    }
    // Pixel centres within rounding of an edge, and faces within 0.1 m.
    EXPECT_LE(different, 20) << "pose " << k;
  }
}

TEST(ZbufferHough, FindsTheOutlineOfABox) {
  const CityModel model = OneBox();
  const std::vector<ProjectedSegment> segments =
      ZbufferHoughSegments(model, kCamera, PoseAt({0, 0, 2}, {}), {});
  const auto found = [&](bool vertical, float at) {
    return std::any_of(segments.begin(), segments.end(), [&](const ProjectedSegment& s) {
      const float a = vertical ? s.a.x() : s.a.y();
      const float b = vertical ? s.b.x() : s.b.y();
      return std::abs(a - at) < 1.5f && std::abs(b - at) < 1.5f && (s.a - s.b).norm() > 60.0f;
    });
  };
  EXPECT_TRUE(found(true, 93.0f));
  EXPECT_TRUE(found(true, 223.0f));
  EXPECT_TRUE(found(false, 46.0f));
  EXPECT_TRUE(found(false, 146.0f));
  for (const ProjectedSegment& segment : segments) {
    EXPECT_EQ(segment.piece, kNoPiece);
    EXPECT_NEAR(segment.depth, 20.0f, 8.1f);
  }
}

TEST(ZbufferHough, SeesNothingOfAnEmptyModel) {
  EXPECT_TRUE(ZbufferHoughSegments({}, kCamera, PoseAt({0, 0, 2}, {}), {}).empty());
}

TEST(ZbufferHough, ValidateNamesTheField) {
  ZbufferHoughOptions options;
  options.votes = 0;
  try {
    CheckOptions(options, "zbuffer_hough");
    FAIL() << "accepted";
  } catch (const InputError& error) {
    EXPECT_EQ(error.field(), "zbuffer_hough.votes");
  }
}

}  // namespace
}  // namespace ridgeline
