// SPDX-License-Identifier: Apache-2.0
#include "input/world.h"

namespace ridgeline {
namespace {

// Terrain farther than this from a camera hides nothing that matters.
constexpr double kTerrainMarginM = 400.0;

}  // namespace

World ReadWorld(const std::vector<std::filesystem::path>& model,
                const std::optional<std::filesystem::path>& dtm,
                const std::string& crs,
                const Eigen::AlignedBox2d& places) {
  World world;
  CityOptions options;
  options.project_to = crs;
  if (!places.isEmpty()) {
    options.region.emplace();
    options.region->positions = places;
  }
  world.model = ReadCity(model, options);
  world.warnings = world.model.warnings;
  if (!dtm) return world;
  const Eigen::Vector2d origin = world.model.origin_in_world.head<2>();
  world.dtm = ReadDtm(*dtm,
                      world.model,
                      places.min() - origin,
                      places.max() - origin,
                      kTerrainMarginM,
                      world.warnings);
  return world;
}

World ReadWorld(const Dataset& dataset, double margin_m) {
  Eigen::AlignedBox2d places;
  for (const Query& query : dataset.queries) {
    if (query.prior) places.extend(query.prior->position_in_world);
    if (query.truth) places.extend(Eigen::Vector2d(query.truth->center_in_world.head<2>()));
  }
  if (!places.isEmpty()) {
    places.min().array() -= margin_m;
    places.max().array() += margin_m;
  }
  return ReadWorld(dataset.model, dataset.dtm, dataset.crs, places);
}

}  // namespace ridgeline
