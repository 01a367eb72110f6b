// SPDX-License-Identifier: Apache-2.0
#include "city/model_terrain.h"

#include <gtest/gtest.h>

#include <array>

namespace ridgeline {
namespace {

constexpr double kSlope = 0.1;
double Plane(const Eigen::Vector2d& xy) { return 5.0 + kSlope * xy.x(); }

// Adds a triangle whose corners are as high above the slope as given.
void AddTriangle(SurfaceClass kind,
                 std::uint32_t building,
                 const std::array<Eigen::Vector2d, 3>& corners,
                 const std::array<double, 3>& above,
                 CityModel& model) {
  Triangle triangle;
  triangle.surface = static_cast<std::uint32_t>(model.surfaces.size());
  for (std::size_t k = 0; k < 3; ++k) {
    triangle.vertices[k] = static_cast<std::uint32_t>(model.vertices.size());
    model.vertices.emplace_back(corners[k].x(), corners[k].y(), Plane(corners[k]) + above[k]);
  }
  model.surfaces.push_back({kind, building, Eigen::Vector3f::UnitZ()});
  model.triangles.push_back(triangle);
}

// Ground surfaces on a slope at the corners of a square of 100 m.
CityModel Slope() {
  CityModel model;
  for (const Eigen::Vector2d& corner : {Eigen::Vector2d(0, 0),
                                        Eigen::Vector2d(100, 0),
                                        Eigen::Vector2d(0, 100),
                                        Eigen::Vector2d(100, 100)}) {
    model.buildings.emplace_back();
    AddTriangle(SurfaceClass::kGround,
                static_cast<std::uint32_t>(model.buildings.size() - 1),
                {corner, corner + Eigen::Vector2d(8, 0), corner + Eigen::Vector2d(0, 8)},
                {0, 0, 0},
                model);
  }
  return model;
}

// Corners of houses on a plane: the plane, whatever the triangulation.
TEST(ModelTerrain, JoinsTheGroundOfBuildingsStraight) {
  const auto terrain = TerrainOfModel(Slope(), {0.0, 0.0}, {100.0, 100.0});
  ASSERT_TRUE(terrain.has_value());
  for (const Eigen::Vector2d& xy :
       {Eigen::Vector2d(50, 50), Eigen::Vector2d(3, 77.7), Eigen::Vector2d(100, 0)}) {
    EXPECT_NEAR(terrain->HeightAt(xy).value(), Plane(xy), 1e-3);  // floats
  }
}

TEST(ModelTerrain, OutsideOfTheBuildingsAsHighAsTheNearest) {
  const auto terrain = TerrainOfModel(Slope(), {-50.0, -50.0}, {150.0, 150.0});
  EXPECT_NEAR(terrain->HeightAt({-40.0, -40.0}).value(), Plane({0.0, 0.0}), 1e-3);
}

// Without a ground surface a building stands on the feet of its walls; a dormer's wall is no foot.
TEST(ModelTerrain, TakesTheFeetOfWallsWhereThereIsNoGround) {
  CityModel model = Slope();
  for (Surface& surface : model.surfaces) surface.surface_class = SurfaceClass::kWall;
  AddTriangle(SurfaceClass::kWall, 0, {{{2, 2}, {4, 2}, {2, 4}}}, {9, 9, 10}, model);
  AddTriangle(SurfaceClass::kRoof, 0, {{{0, 0}, {8, 0}, {0, 8}}}, {7, 7, 7}, model);
  const auto terrain = TerrainOfModel(model, {0.0, 0.0}, {100.0, 100.0});
  ASSERT_TRUE(terrain.has_value());
  EXPECT_NEAR(terrain->HeightAt({3.0, 3.0}).value(), Plane({3.0, 3.0}), 1e-3);
  EXPECT_NEAR(terrain->HeightAt({50.0, 50.0}).value(), Plane({50.0, 50.0}), 1e-3);
}

TEST(ModelTerrain, RoofsAloneMakeNone) {
  CityModel model = Slope();
  for (Surface& surface : model.surfaces) surface.surface_class = SurfaceClass::kRoof;
  EXPECT_FALSE(TerrainOfModel(model, {0.0, 0.0}, {100.0, 100.0}).has_value());
}

}  // namespace
}  // namespace ridgeline
