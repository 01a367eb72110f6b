// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "projection/scene.h"
#include "support/synthetic_city.h"
#include "support/synthetic_terrain.h"

namespace ridgeline {
namespace {

using testing::CityBuilder;
using testing::House;
using testing::MakeCity;
using testing::MakeTerrain;

House HouseAt(double east, double north, double height) {
  House house;
  house.center = {east, north};
  house.length_m = 8.0;
  house.width_m = 10.0;
  house.eaves_m = house.ridge_m = height;
  return house;
}

House WideHouseAt(double east, double north, double height) {
  House house = HouseAt(east, north, height);
  house.width_m = 40.0;
  return house;
}

// What lies on the side of a piece that a direction (local) points to.
Beside On(const VisiblePiece& piece, const Eigen::Vector3d& eye, const Eigen::Vector3f& side) {
  const Eigen::Vector3f view = 0.5f * (piece.a + piece.b) - eye.cast<float>();
  const Eigen::Vector3f left = (piece.b - piece.a).cross(view);
  return left.dot(side) > 0.0f ? piece.left : piece.right;
}

// The longest visible piece through (nearly) a point.
std::optional<VisiblePiece> PieceThrough(const VisibleSet& set, const Eigen::Vector3f& point) {
  for (const VisiblePiece& piece : set.pieces) {
    const Eigen::Vector3f along = (piece.b - piece.a).normalized();
    const Eigen::Vector3f from_a = point - piece.a;
    const float t = along.dot(from_a);
    if (t < 0.0f || t > (piece.b - piece.a).norm()) continue;
    if ((from_a - t * along).norm() < 0.01f) return piece;
  }
  return std::nullopt;
}

const Eigen::Vector3f kUp = Eigen::Vector3f::UnitZ();
const Eigen::Vector3f kEast = Eigen::Vector3f::UnitX();

TEST(Beside, OfASingleHouse) {
  const CityModel model = MakeCity({HouseAt(0, 24, 8)});
  const Scene scene(model, nullptr, {});
  const Eigen::Vector3d eye(0, 0, 2);
  const VisibleSet set = scene.VisibleFrom(eye, {});
  ASSERT_EQ(set.pieces.size(), 4u) << "only the front's outline is visible";
  const auto eaves = PieceThrough(set, {0, 20, 8});
  ASSERT_TRUE(eaves);
  EXPECT_EQ(On(*eaves, eye, kUp), Beside::kSky);
  EXPECT_EQ(On(*eaves, eye, -kUp), Beside::kOwnWall);
  const auto foot = PieceThrough(set, {0, 20, 0});
  ASSERT_TRUE(foot);
  EXPECT_EQ(On(*foot, eye, kUp), Beside::kOwnWall);
  EXPECT_EQ(On(*foot, eye, -kUp), Beside::kGround) << "below the horizontal, without a DTM";
  const auto corner = PieceThrough(set, {5, 20, 6});
  ASSERT_TRUE(corner);
  EXPECT_EQ(On(*corner, eye, -kEast), Beside::kOwnWall);
  EXPECT_EQ(On(*corner, eye, kEast), Beside::kSky);
}

TEST(Beside, FoldsShowBothFaces) {
  const CityModel model = MakeCity({HouseAt(0, 24, 8)});
  const Scene scene(model, nullptr, {});
  const Eigen::Vector3d eye(0, 0, 30);
  const VisibleSet set = scene.VisibleFrom(eye, {});
  const auto eaves = PieceThrough(set, {0, 20, 8});
  ASSERT_TRUE(eaves);
  EXPECT_EQ(On(*eaves, eye, kUp), Beside::kOwnRoof);
  EXPECT_EQ(On(*eaves, eye, -kUp), Beside::kOwnWall);
}

TEST(Beside, AnotherBuildingBehind) {
  const CityModel model = MakeCity({HouseAt(0, 24, 8), WideHouseAt(0, 60, 40)});
  const Scene scene(model, nullptr, {});
  const Eigen::Vector3d eye(0, 0, 2);
  const auto eaves = PieceThrough(scene.VisibleFrom(eye, {}), {0, 20, 8});
  ASSERT_TRUE(eaves);
  EXPECT_EQ(On(*eaves, eye, kUp), Beside::kOtherBuilding);
}

TEST(Beside, AnotherPartOfTheSameBuildingIsOwn) {
  CityModel model = MakeCity({HouseAt(0, 24, 8), WideHouseAt(0, 60, 40)});
  for (Building& building : model.buildings) building.parent_id = "school";
  const Scene scene(model, nullptr, {});
  const Eigen::Vector3d eye(0, 0, 2);
  const auto eaves = PieceThrough(scene.VisibleFrom(eye, {}), {0, 20, 8});
  ASSERT_TRUE(eaves);
  EXPECT_EQ(On(*eaves, eye, kUp), Beside::kOwnWall);
}

TEST(Beside, AHillBehindIsGround) {
  const CityModel model = MakeCity({HouseAt(0, 24, 8)});
  const HeightGrid dtm = MakeTerrain({-200, -50}, 2.0, 200, 200, [](double, double north) {
    return north < 40.0 ? 0.0 : north - 40.0;
  });
  const Scene scene(model, &dtm, {});
  const Eigen::Vector3d eye(0, 0, 2);
  const auto eaves = PieceThrough(scene.VisibleFrom(eye, {}), {0, 20, 8});
  ASSERT_TRUE(eaves);
  EXPECT_EQ(On(*eaves, eye, kUp), Beside::kGround);
}

TEST(VisibleFrom, TerrainHidesWhatIsBehindAHill) {
  const CityModel model = MakeCity({HouseAt(0, 100, 8)});
  // A ridge 5 m high across the line of sight, half way.
  const HeightGrid dtm = MakeTerrain({-200, -50}, 1.0, 400, 250, [](double, double north) {
    return std::max(0.0, 5.0 - std::abs(north - 48.0));
  });
  const Scene scene(model, &dtm, {});
  const Eigen::Vector3d eye(0, 0, 2);
  const VisibleSet set = scene.VisibleFrom(eye, {});
  EXPECT_FALSE(PieceThrough(set, {0, 96, 0})) << "the wall's foot";
  EXPECT_TRUE(PieceThrough(set, {0, 96, 8})) << "the eaves";
  const auto corner = PieceThrough(set, {5, 96, 7.9f});
  ASSERT_TRUE(corner);
  // Over the ridge, taken 0.3 m lower: 2 + (5 - 0.3 - 2) * 2 = 7.4 m at 96 m.
  EXPECT_NEAR(std::min(corner->a.z(), corner->b.z()), 7.4f, 0.02f);
}

// A round tower of many planes, each fold below the least angle of feature edges.
TEST(VisibleFrom, FoldsOfACurvedFacadeAreSeenAsSilhouettes) {
  constexpr int kSides = 48;
  constexpr double kRadius = 10.0;
  CityBuilder builder;
  const std::uint32_t tower = builder.AddBuilding("tower");
  const auto corner = [&](int k, double height) {
    const double angle = 2.0 * std::numbers::pi * k / kSides;
    return Eigen::Vector3d(kRadius * std::cos(angle), 50.0 + kRadius * std::sin(angle), height);
  };
  std::vector<Eigen::Vector3d> roof, ground;
  for (int k = 0; k < kSides; ++k) {
    builder.AddSurface(tower,
                       SurfaceClass::kWall,
                       {corner(k, 0), corner(k + 1, 0), corner(k + 1, 20), corner(k, 20)});
    roof.push_back(corner(k, 20));
    ground.insert(ground.begin(), corner(k, 0));
  }
  builder.AddSurface(tower, SurfaceClass::kRoof, roof);
  builder.AddSurface(tower, SurfaceClass::kGround, ground);
  const CityModel model = builder.Build();
  ASSERT_EQ(model.feature_edges.size(), 2u * kSides) << "upper and lower rim";
  const Scene scene(model, nullptr, {});
  EXPECT_EQ(scene.edge_count(), 3u * kSides);
  const VisibleSet set = scene.VisibleFrom({0, 0, 2}, {});
  std::vector<float> silhouettes;
  for (const VisiblePiece& piece : set.pieces) {
    if (piece.edge < model.feature_edges.size()) continue;
    EXPECT_NEAR(std::abs(piece.a.z() - piece.b.z()), 20.0f, 1e-3f);
    silhouettes.push_back(piece.a.x());
    EXPECT_EQ(On(piece, {0, 0, 2}, kEast * piece.a.x()), Beside::kSky);
    EXPECT_EQ(On(piece, {0, 0, 2}, -kEast * piece.a.x()), Beside::kOwnWall);
  }
  ASSERT_EQ(silhouettes.size(), 2u);
  // The tangent touches at x = r * sqrt(1 - (r / d)^2) = 9.80; the next corner is at most 0.13 off.
  EXPECT_NEAR(std::abs(silhouettes[0]), 9.80f, 0.15f);
  EXPECT_NEAR(silhouettes[0], -silhouettes[1], 1e-4f);
}

}  // namespace
}  // namespace ridgeline
