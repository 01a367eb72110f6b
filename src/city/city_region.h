// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <algorithm>

namespace ridgeline {

// The part of a city that can be seen from a box of positions. A building counts if it is no
// farther from the box than reach_per_height times its height, at least min_reach_m and at most
// max_reach_m: towers are seen from afar.
struct CityRegion {
  Eigen::AlignedBox2d positions;  // east, north in the model's system [m]
  double min_reach_m = 150.0;
  double reach_per_height = 40.0;  // a 10 m house within 400 m
  double max_reach_m = 3000.0;

  // @param footprint  Box around the building; @param height_m  from its lowest to its highest
  // point.
  bool Includes(const Eigen::AlignedBox2d& footprint, double height_m) const {
    const double reach = std::clamp(reach_per_height * height_m, min_reach_m, max_reach_m);
    return positions.exteriorDistance(footprint) <= reach;
  }
};

}  // namespace ridgeline
