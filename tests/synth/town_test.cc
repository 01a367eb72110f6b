// SPDX-License-Identifier: Apache-2.0
#include "synth/town.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>

#include "base/error.h"
#include "synth/town_model.h"

namespace ridgeline {
namespace {

using Eigen::Vector2d;

TEST(Town, HasEveryRoofTypeAndDozensOfBuildings) {
  const Town town = MakeTown(TownOptions{});
  std::set<RoofType> roofs;
  for (const TownBuilding& building : town.buildings) roofs.insert(building.roof);
  EXPECT_GE(town.buildings.size(), 60u);
  EXPECT_EQ(roofs.size(), 5u);
}

TEST(Town, IdsAreUniqueAndPartsFollowTheirBuilding) {
  const Town town = MakeTown(TownOptions{});
  std::set<std::string> ids;
  for (std::size_t i = 0; i < town.buildings.size(); ++i) {
    EXPECT_TRUE(ids.insert(town.buildings[i].id).second);
    EXPECT_LT(town.buildings[i].parent, static_cast<int>(i));
  }
}

// Independent of the separating axes in the generator: points of each footprint, shrunk by 3 cm,
// are in no other building.
TEST(Town, BuildingsDoNotOverlap) {
  const Town town = MakeTown(TownOptions{});
  for (const TownBuilding& building : town.buildings) {
    for (const Vector2d& corner : building.Footprint()) {
      const Vector2d inside = corner + 0.03 * (building.center - corner).normalized();
      int containing = 0;
      for (const TownBuilding& other : town.buildings) {
        Town one;
        one.buildings = {other};
        containing += one.InBuilding(inside) ? 1 : 0;
      }
      EXPECT_EQ(containing, 1) << building.id;
    }
  }
}

TEST(Town, BlocksAreTheSameInATownOfAnySize) {
  TownOptions small;
  TownOptions large;
  large.blocks_east = large.blocks_north = 8;
  const Town whole = MakeTown(small);
  const Town part = MakeTownPart(large, 0, 0, 3, 3);
  ASSERT_EQ(whole.buildings.size(), part.buildings.size());
  for (std::size_t i = 0; i < whole.buildings.size(); ++i) {
    EXPECT_EQ(whole.buildings[i].id, part.buildings[i].id);
    EXPECT_EQ(whole.buildings[i].center, part.buildings[i].center);
    EXPECT_EQ(whole.buildings[i].ridge_m, part.buildings[i].ridge_m);
  }
}

TEST(Town, AnotherSeedIsAnotherTown) {
  TownOptions other;
  other.seed = 2;
  EXPECT_NE(MakeTown(TownOptions{}).buildings[0].length_m, MakeTown(other).buildings[0].length_m);
}

TEST(Town, BaseIsBelowTheGroundAndFloorAboveIt) {
  const Town town = MakeTown(TownOptions{});
  for (const TownBuilding& building : town.buildings) {
    for (const Vector2d& corner : building.Footprint()) {
      EXPECT_LE(building.base_m, town.TerrainHeight(corner));
      EXPECT_GE(building.floor_m, town.TerrainHeight(corner));
    }
  }
}

TEST(TownTerrain, GridHoldsTheHeightsOfTheTown) {
  const Town town = MakeTown(TownOptions{});
  const HeightGrid grid = TownTerrain(town, 20.0);
  for (const auto& [column, row] :
       {std::pair{0, 0}, {100, 57}, {grid.columns - 1, grid.rows - 1}}) {
    const Vector2d xy = grid.first + Vector2d(column, row);
    EXPECT_NEAR(grid.heights[static_cast<std::size_t>(row) * grid.columns + column],
                town.TerrainHeight(xy),
                1e-5);
  }
}

TEST(TownModel, EveryEdgeOfAHouseIsAFeatureEdge) {
  Town town = MakeTown(TownOptions{});
  TownBuilding box;
  box.length_m = box.depth_m = 10.0;
  box.eaves_m = box.ridge_m = 6.0;
  town.buildings = {box};
  EXPECT_EQ(TownModel(town).feature_edges.size(), 12u);  // of a cuboid
  EXPECT_EQ(TownModel(town).vertices.size(), 8u);
  EXPECT_EQ(TownModel(town).triangles.size(), 12u);
}

TEST(SurveyedTown, MovesPartsWithTheirBuilding) {
  const Town town = MakeTown(TownOptions{});
  const Town surveyed = SurveyedTown(town, 0.1);
  double sum = 0.0;
  for (std::size_t i = 0; i < town.buildings.size(); ++i) {
    const Vector2d moved = surveyed.buildings[i].center - town.buildings[i].center;
    sum += moved.squaredNorm();
    const int parent = town.buildings[i].parent;
    if (parent < 0) continue;
    const Vector2d parent_moved = surveyed.buildings[parent].center - town.buildings[parent].center;
    EXPECT_NEAR((moved - parent_moved).norm(), 0.0, 1e-9);
  }
  // Two coordinates of variance 0.01; about 150 buildings.
  EXPECT_NEAR(sum / static_cast<double>(town.buildings.size()), 0.02, 0.006);
}

TEST(TownOptions, NameTheFieldThatIsWrong) {
  TownOptions options;
  options.block_m = 10.0;
  try {
    CheckOptions(options, "town");
    FAIL();
  } catch (const InputError& e) {
    EXPECT_THAT(e.what(), ::testing::HasSubstr("town.block_m"));
  }
}

}  // namespace
}  // namespace ridgeline
