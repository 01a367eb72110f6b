// SPDX-License-Identifier: Apache-2.0
#include "city/raise_roofs.h"

#include <array>
#include <cmath>
#include <map>

namespace ridgeline {
namespace {

// Places to a millimetre.
std::array<std::int64_t, 3> KeyOf(const Eigen::Vector3d& place) {
  return {std::llround(1000.0 * place.x()),
          std::llround(1000.0 * place.y()),
          std::llround(1000.0 * place.z())};
}

}  // namespace

CityModel WithShiftedRoofs(const CityModel& model, std::span<const RoofShift> shifts) {
  CityModel shifted = model;
  std::vector<double> of_building(model.buildings.size(), 0.0);
  for (const RoofShift& shift : shifts) of_building[shift.building] += shift.up_m;
  const auto up_of_roof = [&](std::uint32_t surface) {
    if (surface == kNoSurface) return 0.0;
    const Surface& s = model.surfaces[surface];
    return s.surface_class == SurfaceClass::kRoof ? of_building[s.building] : 0.0;
  };
  std::map<std::array<std::int64_t, 3>, double> up_at;
  for (const Triangle& triangle : model.triangles) {
    const double up = up_of_roof(triangle.surface);
    if (up == 0.0) continue;
    for (const std::uint32_t vertex : triangle.vertices) {
      up_at[KeyOf(model.vertices[vertex])] = up;
      shifted.vertices[vertex].z() = model.vertices[vertex].z() + up;
    }
  }
  for (FeatureEdge& edge : shifted.feature_edges) {
    const bool is_level = std::abs((edge.b - edge.a).normalized().z()) < 0.9;
    const double of_roof = up_of_roof(edge.surface0) != 0.0 ? up_of_roof(edge.surface0)
                                                            : up_of_roof(edge.surface1);
    for (Eigen::Vector3d* end : {&edge.a, &edge.b}) {
      const auto found = up_at.find(KeyOf(*end));
      // Edges may be cut between vertices.
      if (found != up_at.end()) {
        end->z() += found->second;
      } else if (is_level) {
        end->z() += of_roof;
      }
    }
  }
  return shifted;
}

}  // namespace ridgeline
