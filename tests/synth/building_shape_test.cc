// SPDX-License-Identifier: Apache-2.0
#include "synth/building_shape.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <map>
#include <tuple>

namespace ridgeline {
namespace {

using Eigen::Vector3d;

TownBuilding House(RoofType roof, bool ridge_along_x) {
  TownBuilding building;
  building.center = {12.0, -7.0};
  building.direction_rad = 0.4;
  building.length_m = 14.0;
  building.depth_m = 10.0;
  building.base_m = 2.0;
  building.floor_m = 2.3;
  building.eaves_m = 9.0;
  building.ridge_m = roof == RoofType::kFlat ? 9.0 : 13.0;
  building.roof = roof;
  building.ridge_along_x = ridge_along_x;
  return building;
}

using Key = std::tuple<long, long, long>;
Key KeyOf(const Vector3d& p) {
  return {std::lround(p.x() * 1e5), std::lround(p.y() * 1e5), std::lround(p.z() * 1e5)};
}

// Signed volume by the divergence theorem over a fan of each polygon.
double Volume(const std::vector<ShapePolygon>& solid) {
  double volume = 0.0;
  for (const ShapePolygon& polygon : solid) {
    for (std::size_t k = 2; k < polygon.ring.size(); ++k) {
      volume += polygon.ring[0].dot(polygon.ring[k - 1].cross(polygon.ring[k])) / 6.0;
    }
  }
  return volume;
}

class Solids : public ::testing::TestWithParam<std::tuple<RoofType, bool>> {};

TEST_P(Solids, EveryEdgeIsSharedByTwoPolygonsInOppositeDirections) {
  const auto [roof, along_x] = GetParam();
  std::map<std::pair<Key, Key>, int> directed;
  for (const ShapePolygon& polygon : LodTwoSolid(House(roof, along_x))) {
    for (std::size_t i = 0; i < polygon.ring.size(); ++i) {
      const Vector3d& next = polygon.ring[(i + 1) % polygon.ring.size()];
      ++directed[{KeyOf(polygon.ring[i]), KeyOf(next)}];
    }
  }
  for (const auto& [edge, count] : directed) {
    EXPECT_EQ(count, 1);
    EXPECT_EQ(directed.count({edge.second, edge.first}), 1u);
  }
}

TEST_P(Solids, PolygonsArePlaneToATenthOfAMillimetre) {
  const auto [roof, along_x] = GetParam();
  for (const ShapePolygon& polygon : LodTwoSolid(House(roof, along_x))) {
    const Vector3d normal = polygon.Normal();
    for (const Vector3d& p : polygon.ring) {
      EXPECT_NEAR(normal.dot(p - polygon.ring[0]), 0.0, 1e-4);
    }
  }
}

// Box below the eaves plus the roof body above them, by their formulas.
TEST_P(Solids, VolumeIsThatOfBoxAndRoof) {
  const auto [roof, along_x] = GetParam();
  const double box = 14.0 * 10.0 * 7.0;
  const double rise = 4.0;
  const double along = along_x ? 14.0 : 10.0;
  const double across = along_x ? 10.0 : 14.0;
  double body = 0.0;
  if (roof == RoofType::kGable || roof == RoofType::kShed) body = 0.5 * along * across * rise;
  if (roof == RoofType::kPyramid) body = along * across * rise / 3.0;
  if (roof == RoofType::kHip) {
    const double ridge = std::max(0.4, along - std::min(along, across));
    body = across * rise / 6.0 * (2.0 * along + ridge);  // wedge
  }
  EXPECT_NEAR(Volume(LodTwoSolid(House(roof, along_x))), box + body, 1e-6);
}

INSTANTIATE_TEST_SUITE_P(AllRoofs,
                         Solids,
                         ::testing::Combine(::testing::Values(RoofType::kFlat,
                                                              RoofType::kGable,
                                                              RoofType::kHip,
                                                              RoofType::kPyramid,
                                                              RoofType::kShed),
                                            ::testing::Bool()));

TEST(BuiltRoof, OverhangsTheWallsOnAllSides) {
  const TownBuilding house = House(RoofType::kHip, true);
  const auto footprint = house.Footprint();
  double reach = 0.0;
  for (const ShapePolygon& polygon : BuiltRoof(house, 0.4)) {
    for (const Vector3d& p : polygon.ring) {
      reach = std::max(reach, (p.head<2>() - house.center).norm());
    }
  }
  const double corner = (footprint[0] - house.center).norm();
  EXPECT_NEAR(reach, corner + 0.4 * std::sqrt(2.0), 0.02);
}

}  // namespace
}  // namespace ridgeline
