// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

#include "city/terrain.h"

namespace ridgeline {

struct TerrainMesh {
  std::vector<Eigen::Vector3f> vertices;                // local frame [m]
  std::vector<std::array<std::uint32_t, 3>> triangles;  // counter-clockwise from above
};

// Right-triangulated irregular network over the grid: few triangles where the ground is flat. The
// height at the middle of each triangle's long side that was not split further is within
// `max_error_m`. Cells beside unknown heights are left out. Throws InputError for a grid whose
// sizes and number of heights disagree. Source: Evans, Kirkpatrick & Townsend, "Right-triangulated
// irregular networks", 2001.
TerrainMesh MeshTerrain(const HeightGrid& grid, double max_error_m);

}  // namespace ridgeline
