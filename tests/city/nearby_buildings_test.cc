// SPDX-License-Identifier: Apache-2.0
#include "city/nearby_buildings.h"

#include <gtest/gtest.h>

#include <set>

#include "support/synthetic_city.h"

namespace ridgeline {
namespace {

TEST(NearbyBuildings, AreThoseWithACornerWithinTheRadius) {
  const std::vector<testing::House> houses = testing::TownHouses(3, 3, 5);
  const CityModel model = testing::MakeCity(houses);
  const Eigen::Vector2d place(70.0, 50.0);
  for (const double radius_m : {0.0, 20.0, 55.0, 1000.0}) {
    // By brute force over the corners of each building.
    std::set<std::uint32_t> expected;
    for (const Triangle& triangle : model.triangles) {
      for (const std::uint32_t vertex : triangle.vertices) {
        if ((model.vertices[vertex].head<2>() - place).norm() <= radius_m) {
          expected.insert(model.surfaces[triangle.surface].building);
        }
      }
    }
    const CityModel nearby = NearbyBuildings(model, place, radius_m);
    std::set<std::uint32_t> kept;
    for (const Triangle& triangle : nearby.triangles) {
      kept.insert(nearby.surfaces[triangle.surface].building);
    }
    EXPECT_EQ(kept, expected) << radius_m << " m";
    for (const FeatureEdge& edge : nearby.feature_edges) {
      EXPECT_TRUE(expected.contains(nearby.surfaces[edge.surface0].building));
    }
    EXPECT_EQ(nearby.buildings.size(), model.buildings.size()) << "indices stay";
  }
}

TEST(NearbyBuildings, KeepAllOfTheirTrianglesAndEdges) {
  const CityModel model = testing::MakeCity(testing::TownHouses(2, 2, 5));
  const CityModel nearby = NearbyBuildings(model, {0.0, 0.0}, 1e4);
  EXPECT_EQ(nearby.triangles.size(), model.triangles.size());
  EXPECT_EQ(nearby.feature_edges.size(), model.feature_edges.size());
}

}  // namespace
}  // namespace ridgeline
