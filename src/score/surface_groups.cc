// SPDX-License-Identifier: Apache-2.0
#include "score/surface_groups.h"

#include <unordered_map>

namespace ridgeline {
namespace {

// Surfaces whose normal rises more than this are roofs.
constexpr float kRoofNormal = 0.25f;

bool IsGround(const Surface& surface) {
  return surface.surface_class == SurfaceClass::kGround ||
         surface.surface_class == SurfaceClass::kTerrain;
}

}  // namespace

SurfaceGroups GroupsOf(const SurfacePanorama& panorama, const CityModel& model) {
  SurfaceGroups groups;
  groups.of_cell.reserve(panorama.surfaces.size());
  std::unordered_map<std::uint32_t, std::uint16_t> of_key;
  std::uint32_t last_surface = kTerrainSurface;
  std::uint16_t last_group = kGroundGroup;
  const auto group_of = [&](std::uint32_t index) -> std::uint16_t {
    if (index == kTerrainSurface) return kGroundGroup;
    const Surface& surface = model.surfaces[index];
    if (IsGround(surface)) return kGroundGroup;
    const std::uint32_t key = 2 * surface.building + (surface.normal.z() > kRoofNormal ? 1 : 0);
    const auto [entry, is_new] = of_key.try_emplace(key, static_cast<std::uint16_t>(groups.count));
    if (is_new && groups.count < kNoGroup) ++groups.count;
    return entry->second;
  };
  for (int row = 0; row < panorama.rows; ++row) {
    // Beyond the model and the terrain the ground goes on to the horizon.
    const bool is_upward = panorama.first_elevation + row * panorama.step > 0.0;
    for (int column = 0; column < panorama.columns; ++column) {
      const std::uint32_t surface = panorama.surfaces[groups.of_cell.size()];
      if (surface == kNoSurface) {
        groups.of_cell.push_back(is_upward ? kSkyGroup : kGroundGroup);
        continue;
      }
      if (surface != last_surface) {
        last_surface = surface;
        last_group = group_of(surface);
      }
      groups.of_cell.push_back(last_group);
    }
  }
  return groups;
}

}  // namespace ridgeline
