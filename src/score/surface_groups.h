// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "city/city_model.h"
#include "projection/surface_panorama.h"

namespace ridgeline {

inline constexpr std::uint16_t kSkyGroup = 0;
inline constexpr std::uint16_t kGroundGroup = 1;  // terrain, or below the horizontal behind it
inline constexpr std::uint16_t kFirstBuildingGroup = 2;
inline constexpr std::uint16_t kNoGroup = 0xFFFF;

// What is seen from a position, told apart as far as colours may differ: the sky, the ground, and
// the walls and the roofs of each building.
struct SurfaceGroups {
  std::vector<std::uint16_t> of_cell;  // by cell of the panorama
  int count = kFirstBuildingGroup;
};

SurfaceGroups GroupsOf(const SurfacePanorama& panorama, const CityModel& model);

}  // namespace ridgeline
