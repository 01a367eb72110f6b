// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "city/city_model.h"
#include "projection/occluder_bvh.h"
#include "projection/terrain_mesh.h"
#include "projection/triangle_edges.h"

namespace ridgeline {

// The model's triangles; pairs of one plane that make a convex quadrangle are one, so that a wall
// is one occluder.
std::vector<Occluder> ModelOccluders(const CityModel& model,
                                     const TriangleEdges& mesh,
                                     double tolerance_m);

// The terrain's triangles, lowered.
std::vector<Occluder> TerrainOccluders(const TerrainMesh& terrain, double lowered_by_m);

}  // namespace ridgeline
