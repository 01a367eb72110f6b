// SPDX-License-Identifier: Apache-2.0
#include "input/world.h"

#include "base/error.h"
#include "city/model_terrain.h"

namespace ridgeline {
namespace {

// Terrain farther than this from a camera hides nothing that matters.
constexpr double kTerrainMarginM = 400.0;

Eigen::AlignedBox2d ExtentOf(const CityModel& model) {
  Eigen::AlignedBox2d extent;
  for (const Eigen::Vector3d& vertex : model.vertices) {
    extent.extend(Eigen::Vector2d(vertex.head<2>()));
  }
  return extent;
}

void AddTerrain(const WorldRequest& request, World& world) {
  const Eigen::Vector2d origin = world.model.origin_in_world.head<2>();
  Eigen::AlignedBox2d box;
  if (!request.places.isEmpty()) box = request.places.translated(-origin);
  if (request.whole_model || box.isEmpty()) box.extend(ExtentOf(world.model));
  if (request.dtm) {
    world.dtm =
        ReadDtm(*request.dtm, world.model, box.min(), box.max(), kTerrainMarginM, world.warnings);
    return;
  }
  if (!request.needs_terrain) return;
  const Eigen::Vector2d margin = Eigen::Vector2d::Constant(kTerrainMarginM);
  world.dtm = TerrainOfModel(world.model, box.min() - margin, box.max() + margin);
  if (!world.dtm) {
    throw InputError("--dtm",
                     "",
                     "no terrain model, a position without a height, and a model without ground "
                     "surfaces and walls",
                     "a terrain raster, or the height of the camera in its position");
  }
  world.dtm_of_model = true;
  world.warnings.push_back(
      "no terrain model (--dtm): the ground is taken from where the model's buildings stand, and "
      "straight between them");
}

}  // namespace

World ReadWorld(const WorldRequest& request) {
  World world;
  CityOptions options;
  options.project_to = request.crs;
  options.threads = request.threads;
  if (!request.whole_model && !request.places.isEmpty()) {
    options.region.emplace();
    options.region->positions = request.places;
  }
  world.model = ReadCity(request.model, options);
  world.warnings = world.model.warnings;
  AddTerrain(request, world);
  return world;
}

WorldRequest RequestFor(const Dataset& dataset, double margin_m) {
  WorldRequest request;
  request.model = dataset.model;
  request.dtm = dataset.dtm;
  request.crs = dataset.crs;
  for (const Query& query : dataset.queries) {
    if (query.prior) request.places.extend(query.prior->position_in_world);
    if (query.truth) {
      request.places.extend(Eigen::Vector2d(query.truth->center_in_world.head<2>()));
    }
    request.needs_terrain = request.needs_terrain || (query.prior && !query.prior->height_in_world);
  }
  if (!request.places.isEmpty()) {
    request.places.min().array() -= margin_m;
    request.places.max().array() += margin_m;
  }
  return request;
}

World ReadWorld(const Dataset& dataset, double margin_m) {
  return ReadWorld(RequestFor(dataset, margin_m));
}

}  // namespace ridgeline
