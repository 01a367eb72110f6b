// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <functional>

#include "study/scored_map.h"

namespace ridgeline::testing {

// A map of 21 x 21 positions, 1 m apart, and 41 headings, 1 degree apart, around a prior; the truth
// lies at (east, north) and heading_deg from it. log_ratio(distance [m], angle [deg]) of each pose.
inline ScoredMap HandMadeMap(double east,
                             double north,
                             double heading_deg,
                             const std::function<double(double, double)>& log_ratio) {
  ScoredMap map;
  for (int i = -10; i <= 10; ++i) {
    map.volume.east_m.push_back(i);
    map.volume.north_m.push_back(i);
  }
  map.volume.height_m = {0.0};
  for (int i = -20; i <= 20; ++i) {
    map.volume.heading_deg.push_back(i);
    map.rotation_deg.push_back(std::abs(i - heading_deg));
  }
  map.volume.tilts = {Tilt{}};
  for (const double n : map.volume.north_m) {
    for (const double e : map.volume.east_m) {
      map.translation_m.push_back(std::hypot(e - east, n - north));
      map.admissible.push_back(1);
      for (const double angle : map.rotation_deg) {
        map.volume.log_ratios.push_back(
            static_cast<float>(log_ratio(map.translation_m.back(), angle)));
      }
    }
  }
  return map;
}

}  // namespace ridgeline::testing
