// SPDX-License-Identifier: Apache-2.0
#include "projection/ray_visibility.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "base/random.h"
#include "support/synthetic_city.h"
#include "support/synthetic_terrain.h"

namespace ridgeline {
namespace {

const testing::House kBefore{{0.0, 20.0}, 6.0, 12.0, 0.0, 0.0, 8.0, 8.0};
const testing::House kBehind{{0.0, 40.0}, 6.0, 12.0, 0.0, 0.0, 8.0, 8.0};

TEST(RayVisibility, AHouseHidesWhatIsBehindIt) {
  const CityModel model = testing::MakeCity({kBefore, kBehind});
  const RayVisibility rays(model, nullptr, ProjectionOptions{});
  const Eigen::Vector3d eye(0.0, 0.0, 1.6);
  EXPECT_TRUE(rays.Look(eye, {0.0, 17.0, 8.0}).visible);  // the front eaves
  const auto hidden = rays.Look(eye, {0.0, 37.0, 4.0});
  EXPECT_FALSE(hidden.visible);
  EXPECT_GT(hidden.depth_m, 10.0);
  EXPECT_TRUE(rays.Look(eye, {0.0, 37.0, 30.0}).visible);  // above the roofs
}

TEST(RayVisibility, TheTerrainHidesLowered) {
  const CityModel model = testing::MakeCity({{{0.0, 60.0}, 6.0, 12.0, 0.0, 0.0, 8.0, 8.0}});
  const HeightGrid hill = testing::MakeTerrain({-100.0, -100.0}, 2.0, 101, 101, [](double, double y) {
    return 6.0 * std::exp(-0.5 * std::pow((y - 30.0) / 5.0, 2.0));
  });
  const RayVisibility rays(model, &hill, ProjectionOptions{});
  const auto foot = rays.Look({0.0, 0.0, 1.6}, {0.0, 57.0, 0.2});
  EXPECT_FALSE(foot.visible);
  EXPECT_TRUE(foot.by_terrain);
  EXPECT_TRUE(rays.Look({0.0, 0.0, 20.0}, {0.0, 57.0, 8.0}).visible);
}

// Two ways to the same visibility: lengths of the visible parts agree to the spacing of the rays.
TEST(RayVisibility, AgreesWithTheExactWayInATown) {
  const CityModel model = testing::MakeCity(testing::TownHouses(2, 2, 5));
  ProjectionOptions options;
  options.min_piece_mrad = 0.0;
  const Scene scene(model, nullptr, options);
  const RayVisibility rays(model, nullptr, options);
  Random random(7, 0, 0);
  double exact_m = 0.0, differs_m = 0.0;
  for (int i = 0; i < 6; ++i) {
    // Along a street, which lies at multiples of the pitch.
    const Eigen::Vector3d eye(testing::kBlockPitch, random.Uniform(10.0, 110.0), 1.6);
    std::map<std::uint32_t, double> length;
    for (const VisiblePiece& piece : scene.VisibleFrom(eye, Sector{}).pieces) {
      if (piece.edge >= model.feature_edges.size()) continue;
      length[piece.edge] += (piece.b - piece.a).norm();
      exact_m += (piece.b - piece.a).norm();
    }
    for (const VisiblePiece& piece : rays.PiecesFrom(eye, options.max_distance_m, 2.0)) {
      length[piece.edge] -= (piece.b - piece.a).norm();
    }
    for (const auto& [edge, difference] : length) differs_m += std::abs(difference);
  }
  EXPECT_GT(exact_m, 1000.0);
  EXPECT_LT(differs_m, 0.03 * exact_m);
}

}  // namespace
}  // namespace ridgeline
