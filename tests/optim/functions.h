// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <numbers>
#include <span>
#include <string>
#include <vector>

#include "optim/search_box.h"

namespace ridgeline {

inline SearchBox CubeBox(int dimensions, double lower, double upper) {
  SearchBox box;
  for (int d = 0; d < dimensions; ++d) {
    box.parameters.push_back({"x" + std::to_string(d), lower, upper});
  }
  return box;
}

// A box as localization has it: position, a full circle of headings, a fixed height, a pitch.
inline SearchBox PoseLikeBox() {
  SearchBox box;
  box.parameters = {{"east_m", -20.0, 20.0},
                    {"north_m", -20.0, 20.0},
                    {"height_m", 1.7, 1.7},
                    {"heading_deg", 0.0, 360.0, true},
                    {"pitch_deg", -5.0, 5.0}};
  return box;
}

// Smooth, least (0) at (3, -4, 1.7, 358, 1) of PoseLikeBox(): beside the seam of the heading.
inline double PoseLikeEnergy(std::span<const double> v) {
  const double heading = std::remainder(v[3] - 358.0, 360.0) / 180.0;
  const double east = (v[0] - 3.0) / 20.0;
  const double north = (v[1] + 4.0) / 20.0;
  const double pitch = (v[4] - 1.0) / 5.0;
  return east * east + north * north + heading * heading + 0.1 * pitch * pitch;
}

inline double Sphere(std::span<const double> x) {
  double sum = 0.0;
  for (const double v : x) sum += v * v;
  return sum;
}

// Valley along x1 = x0^2, least (0) at (1, ..., 1).
inline double Rosenbrock(std::span<const double> x) {
  double sum = 0.0;
  for (std::size_t i = 0; i + 1 < x.size(); ++i) {
    const double a = x[i + 1] - x[i] * x[i];
    sum += 100.0 * a * a + (1.0 - x[i]) * (1.0 - x[i]);
  }
  return sum;
}

}  // namespace ridgeline
