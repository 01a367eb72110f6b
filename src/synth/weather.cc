// SPDX-License-Identifier: Apache-2.0
#include "synth/weather.h"

#include <algorithm>
#include <cmath>

#include "base/angle.h"
#include "synth/paint.h"

namespace ridgeline {

using Eigen::Vector3f;

Weather DrawWeather(Random& random) {
  const double azimuth = random.Uniform(80.0, 280.0) * kRadPerDeg;
  const double elevation = random.Uniform(18.0, 55.0) * kRadPerDeg;
  Weather weather;
  weather.to_sun = Vector3f(static_cast<float>(std::sin(azimuth) * std::cos(elevation)),
                            static_cast<float>(std::cos(azimuth) * std::cos(elevation)),
                            static_cast<float>(std::sin(elevation)));
  const bool sunny = random.Uniform() < 0.67;
  weather.sun = sunny ? static_cast<float>(random.Uniform(0.7, 1.0)) : 0.0f;
  weather.cloud_cover =
      static_cast<float>(sunny ? random.Uniform(0.0, 0.55) : random.Uniform(0.85, 1.0));
  weather.key = random.Next();
  return weather;
}

Vector3f SkyColor(const Weather& weather, const Vector3f& direction) {
  const float up = std::max(0.0f, direction.z());
  const Vector3f zenith(0.20f, 0.36f, 0.72f);
  const Vector3f horizon(0.72f, 0.80f, 0.88f);
  const Vector3f blue = horizon + (zenith - horizon) * std::pow(up, 0.5f);
  // Clouds on a plane above; they thin out in the haze of the horizon.
  const Eigen::Vector2f plane = direction.head<2>() / (up + 0.12f);
  const float noise = FractalNoise(plane * 1.3f, 5, weather.key);
  const float threshold = 1.0f - weather.cloud_cover;
  const float cloud = std::clamp((noise - 0.7f * threshold - 0.08f) * 4.0f, 0.0f, 1.0f) *
                      std::clamp(up * 8.0f + 0.3f, 0.0f, 1.0f);
  const float white = 0.65f + 0.45f * FractalNoise(plane * 2.1f, 3, weather.key + 99);
  const float glow = weather.sun * std::pow(std::max(0.0f, direction.dot(weather.to_sun)), 60.0f);
  return blue + (Vector3f::Constant(white) - blue) * cloud + Vector3f::Constant(0.8f * glow);
}

Vector3f SkyLight(const Weather& weather) {
  const Vector3f clear(0.42f, 0.50f, 0.62f);
  const Vector3f overcast(0.78f, 0.80f, 0.84f);
  return clear + (overcast - clear) * weather.cloud_cover;
}

}  // namespace ridgeline
