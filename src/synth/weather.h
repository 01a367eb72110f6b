// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "base/random.h"

namespace ridgeline {

// Light of a photo.
struct Weather {
  Eigen::Vector3f to_sun{0.0f, 0.0f, 1.0f};  // unit, local frame
  float sun = 1.0f;                          // 0: overcast
  float cloud_cover = 0.4f;                  // [0, 1]
  std::uint64_t key = 0;                     // of the clouds
};

// Two in three days are sunny; the sun stands 18 to 55 degrees high in the east, south or west.
Weather DrawWeather(Random& random);

// Radiance of the sky in a direction (unit, local frame), linear RGB.
Eigen::Vector3f SkyColor(const Weather& weather, const Eigen::Vector3f& direction);

// Light of the whole sky on a level surface.
Eigen::Vector3f SkyLight(const Weather& weather);

}  // namespace ridgeline
