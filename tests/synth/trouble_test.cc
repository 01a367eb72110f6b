// SPDX-License-Identifier: Apache-2.0
#include "synth/trouble.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <string>

#include "base/error.h"
#include "synth/town_model.h"

namespace ridgeline {
namespace {

Town BigTown() {
  TownOptions options;
  options.blocks_east = options.blocks_north = 6;
  return MakeTown(options);
}

std::map<std::string, TownBuilding> ById(const Town& town) {
  std::map<std::string, TownBuilding> buildings;
  for (const TownBuilding& building : town.buildings) buildings[building.id] = building;
  return buildings;
}

TEST(Trouble, NoneLeavesTheTownAsItIs) {
  const Town town = BigTown();
  for (const Town& same : {StandingTown(town, {}), ModelledTown(town, {})}) {
    ASSERT_EQ(same.buildings.size(), town.buildings.size());
    for (std::size_t i = 0; i < town.buildings.size(); ++i) {
      EXPECT_EQ(same.buildings[i].center, town.buildings[i].center);
      EXPECT_EQ(same.buildings[i].eaves_m, town.buildings[i].eaves_m);
      EXPECT_EQ(same.buildings[i].ridge_m, town.buildings[i].ridge_m);
      EXPECT_EQ(same.buildings[i].parent, town.buildings[i].parent);
    }
  }
  EXPECT_EQ(FocalFactor({}, 1, 2), 1.0);
}

TEST(Trouble, BuildingsAreMissingAndGoneInTheirSharesWithAllTheirParts) {
  const Town town = BigTown();
  TroubleOptions options;
  options.missing_share = 0.2;
  options.gone_share = 0.1;
  const Town standing = StandingTown(town, options);
  const Town model = ModelledTown(town, options);
  const double all = static_cast<double>(town.buildings.size());
  EXPECT_NEAR(static_cast<double>(standing.buildings.size()) / all, 0.9, 0.04);
  EXPECT_NEAR(static_cast<double>(model.buildings.size()) / all, 0.8, 0.05);
  const auto originals = ById(town);
  for (const Town* part : {&standing, &model}) {
    for (std::size_t i = 0; i < part->buildings.size(); ++i) {
      const TownBuilding& building = part->buildings[i];
      const TownBuilding& original = originals.at(building.id);
      ASSERT_LT(building.parent, static_cast<int>(i));
      ASSERT_EQ(building.parent < 0, original.parent < 0);
      if (building.parent < 0) continue;
      EXPECT_EQ(part->buildings[static_cast<std::size_t>(building.parent)].id,
                town.buildings[static_cast<std::size_t>(original.parent)].id);
    }
  }
  // Drawn apart: some that are missing stand, some that are gone are modelled.
  const auto stands = ById(standing);
  const auto modelled = ById(model);
  const auto only = [](const auto& a, const auto& b) {
    return std::count_if(
        a.begin(), a.end(), [&](const auto& entry) { return !b.contains(entry.first); });
  };
  EXPECT_GT(only(stands, modelled), 20);
  EXPECT_GT(only(modelled, stands), 10);
}

TEST(Trouble, RoofsAndOutlinesOfAShareAreWrongWithinTheirLimits) {
  const Town town = BigTown();
  TroubleOptions options;
  options.wrong_share = 0.4;
  options.roof_m = 2.0;
  options.outline_m = 1.0;
  const auto originals = ById(town);
  int wrong = 0;
  double most_roof_m = 0.0;
  for (const TownBuilding& building : ModelledTown(town, options).buildings) {
    const TownBuilding& original = originals.at(building.id);
    const Eigen::Vector2d shift = building.center - original.center;
    wrong += shift.norm() > 0.0 ? 1 : 0;
    EXPECT_LE(shift.cwiseAbs().maxCoeff(), 1.0 + 1e-9);
    EXPECT_LE(std::abs(building.length_m - original.length_m), 1.0 + 1e-9);
    EXPECT_LE(std::abs(building.eaves_m - original.eaves_m), 2.0 + 1e-9);
    EXPECT_GE(building.ridge_m, building.eaves_m);
    EXPECT_GT(building.eaves_m, building.floor_m);
    most_roof_m = std::max(most_roof_m, std::abs(building.eaves_m - original.eaves_m));
  }
  EXPECT_NEAR(wrong / static_cast<double>(originals.size()), 0.4, 0.06);
  EXPECT_GT(most_roof_m, 1.8);
}

TEST(Trouble, LodOneHasFlatRoofsHalfwayUp) {
  const Town town = BigTown();
  TroubleOptions options;
  options.lod = 1;
  const auto originals = ById(town);
  for (const TownBuilding& building : ModelledTown(town, options).buildings) {
    const TownBuilding& original = originals.at(building.id);
    EXPECT_EQ(building.roof, RoofType::kFlat);
    EXPECT_DOUBLE_EQ(building.eaves_m, 0.5 * (original.eaves_m + original.ridge_m));
    EXPECT_EQ(building.ridge_m, building.eaves_m);
  }
}

TEST(Trouble, FocalLengthsAreWrongWithinTheShare) {
  TroubleOptions options;
  options.focal_share = 0.05;
  double least = 1.0;
  double most = 1.0;
  for (std::uint64_t key = 0; key < 300; ++key) {
    least = std::min(least, FocalFactor(options, 1, key));
    most = std::max(most, FocalFactor(options, 1, key));
  }
  EXPECT_NEAR(least, 0.95, 0.002);
  EXPECT_NEAR(most, 1.05, 0.002);
}

TEST(Trouble, BadOptionsAreNamed) {
  TroubleOptions options;
  options.roof_m = -1.0;
  EXPECT_THROW(CheckOptions(options), InputError);
  options = {};
  options.lod = 3;
  EXPECT_THROW(CheckOptions(options), InputError);
}

TEST(TownStyles, DifferInHeightAndAnUnknownOneIsNamed) {
  const auto mean_storeys = [](const std::string& style) {
    TownOptions options;
    options.style = style;
    const Town town = MakeTown(options);
    double sum = 0.0;
    for (const TownBuilding& building : town.buildings) sum += building.storeys;
    return sum / static_cast<double>(town.buildings.size());
  };
  EXPECT_LT(mean_storeys("suburb") + 1.0, mean_storeys("centre"));
  EXPECT_LT(mean_storeys("village") + 1.0, mean_storeys("estate"));
  TownOptions options;
  options.style = "castle";
  EXPECT_THROW(CheckOptions(options), InputError);
}

}  // namespace
}  // namespace ridgeline
