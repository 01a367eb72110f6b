// SPDX-License-Identifier: Apache-2.0
#include "city/nearby_buildings.h"

#include <vector>

namespace ridgeline {

CityModel NearbyBuildings(const CityModel& model, const Eigen::Vector2d& place, double radius_m) {
  std::vector<bool> is_near(model.buildings.size(), false);
  for (const Triangle& triangle : model.triangles) {
    for (const std::uint32_t vertex : triangle.vertices) {
      const Eigen::Vector2d corner = model.vertices[vertex].head<2>();
      if ((corner - place).squaredNorm() > radius_m * radius_m) continue;
      is_near[model.surfaces[triangle.surface].building] = true;
    }
  }
  const auto is_kept = [&](std::uint32_t surface) {
    return surface != kNoSurface && is_near[model.surfaces[surface].building];
  };
  CityModel nearby;
  nearby.crs = model.crs;
  nearby.origin_in_world = model.origin_in_world;
  nearby.vertices = model.vertices;
  nearby.surfaces = model.surfaces;
  nearby.buildings = model.buildings;
  for (const Triangle& triangle : model.triangles) {
    if (is_kept(triangle.surface)) nearby.triangles.push_back(triangle);
  }
  for (const FeatureEdge& edge : model.feature_edges) {
    if (is_kept(edge.surface0) || is_kept(edge.surface1)) nearby.feature_edges.push_back(edge);
  }
  return nearby;
}

}  // namespace ridgeline
