// SPDX-License-Identifier: Apache-2.0
#include "synth/trouble.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "base/random.h"

namespace ridgeline {
namespace {

constexpr std::uint64_t kGoneStage = 0x90;
constexpr std::uint64_t kMissingStage = 0x91;
constexpr std::uint64_t kWrongStage = 0x92;
constexpr std::uint64_t kFocalStage = 0x93;
// A building keeps at least this [m].
constexpr double kLeastSideM = 3.0;
constexpr double kLeastStoreyM = 2.0;

// The building that a building or part belongs to.
const TownBuilding& Whole(const Town& town, const TownBuilding& building) {
  return building.parent < 0 ? building : town.buildings[static_cast<std::size_t>(building.parent)];
}

Random StreamOf(const Town& town, std::uint64_t stage, const TownBuilding& building) {
  return {static_cast<std::uint64_t>(town.options.seed), stage, HashText(Whole(town, building).id)};
}

Town Without(const Town& town, double share, std::uint64_t stage) {
  if (share == 0.0) return town;
  Town rest = town;
  rest.buildings.clear();
  std::vector<int> place(town.buildings.size(), -1);
  for (std::size_t i = 0; i < town.buildings.size(); ++i) {
    TownBuilding building = town.buildings[i];
    if (StreamOf(town, stage, building).Uniform() < share) continue;
    place[i] = static_cast<int>(rest.buildings.size());
    if (building.parent >= 0) building.parent = place[static_cast<std::size_t>(building.parent)];
    rest.buildings.push_back(std::move(building));
  }
  return rest;
}

void MakeWrong(const Town& town, const TroubleOptions& options, TownBuilding& building) {
  Random random = StreamOf(town, kWrongStage, building);
  if (random.Uniform() >= options.wrong_share) return;
  const double roof_m = options.roof_m;
  const double outline_m = options.outline_m;
  // One error for a building and its parts; the slope of a roof is wrong on its own.
  const double eaves = random.Uniform(-roof_m, roof_m);
  const double ridge = random.Uniform(-roof_m, roof_m);
  building.center +=
      Eigen::Vector2d(random.Uniform(-outline_m, outline_m), random.Uniform(-outline_m, outline_m));
  const double longer = random.Uniform(-outline_m, outline_m);
  const double deeper = random.Uniform(-outline_m, outline_m);
  if (building.parent < 0) {
    building.length_m = std::max(kLeastSideM, building.length_m + longer);
    building.depth_m = std::max(kLeastSideM, building.depth_m + deeper);
  }
  const bool flat = building.roof == RoofType::kFlat;
  building.eaves_m = std::max(building.floor_m + kLeastStoreyM, building.eaves_m + eaves);
  constexpr double kLeastRiseM = 0.5;
  building.ridge_m =
      flat ? building.eaves_m : std::max(building.eaves_m + kLeastRiseM, building.ridge_m + ridge);
}

void Flatten(TownBuilding& building) {
  building.eaves_m = building.ridge_m = 0.5 * (building.eaves_m + building.ridge_m);
  building.roof = RoofType::kFlat;
}

}  // namespace

Town StandingTown(const Town& town, const TroubleOptions& options) {
  return Without(town, options.gone_share, kGoneStage);
}

Town ModelledTown(const Town& town, const TroubleOptions& options) {
  Town model = town;
  for (TownBuilding& building : model.buildings) {
    MakeWrong(town, options, building);
    if (options.lod == 1) Flatten(building);
  }
  return Without(model, options.missing_share, kMissingStage);
}

double FocalFactor(const TroubleOptions& options, int seed, std::uint64_t key) {
  Random random(static_cast<std::uint64_t>(seed), kFocalStage, key);
  return 1.0 + random.Uniform(-options.focal_share, options.focal_share);
}

}  // namespace ridgeline
