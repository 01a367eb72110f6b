// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <optional>

#include "city/city_model.h"
#include "city/terrain.h"

namespace ridgeline {

// A terrain from a city model alone, for want of a terrain model: the heights at which its
// buildings stand, joined by a Delaunay triangulation (GDAL's linear gridding), the nearest one's
// height outside of it. Buildings stand on the corners of their ground surfaces; without these, on
// the lowest points of their walls that no steeper slope than 30 % joins to the lowest of all.
// Streets between buildings are as right as the ground between two houses is straight; ground
// surfaces of LoD2 are often flat at the lowest corner, so on a slope the terrain comes out low.
//
// @param lower, upper  Box to cover, local frame [m].
// nullopt: fewer than three places on the ground.
std::optional<HeightGrid> TerrainOfModel(const CityModel& model,
                                         const Eigen::Vector2d& lower,
                                         const Eigen::Vector2d& upper);

}  // namespace ridgeline
