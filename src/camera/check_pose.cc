// SPDX-License-Identifier: Apache-2.0
#include "camera/check_pose.h"

#include <cmath>
#include <cstdio>

#include "base/error.h"
#include "base/limits.h"

namespace ridgeline {
namespace {

std::string Text(double value) {
  char text[40];
  std::snprintf(text, sizeof text, "%.10g", value);
  return text;
}

}  // namespace

void CheckPlace(const Eigen::Vector3d& center_in_world,
                const std::string& file,
                const std::string& field) {
  for (const double value : {center_in_world.x(), center_in_world.y()}) {
    if (std::abs(value) <= limits::kCoordinate) continue;  // false for NaN
    throw InputError(file, field, Text(value), "east and north in metres, below 1e8");
  }
  const double height = center_in_world.z();
  if (std::abs(height) <= limits::kHeight) return;
  throw InputError(file, field, "the height " + Text(height), "a height in metres, below 1e5");
}

Eigen::Quaterniond UnitQuaternion(std::span<const double> wxyz,
                                  const std::string& file,
                                  const std::string& field) {
  Eigen::Quaterniond q(wxyz[0], wxyz[1], wxyz[2], wxyz[3]);
  constexpr double kUnitTolerance = 1e-3;  // hand-written quaternions have a few digits
  const double deviation = std::abs(q.norm() - 1.0);
  if (!(deviation <= kUnitTolerance)) {  // true for NaN
    throw InputError(file, field, "norm " + Text(q.norm()), "a unit quaternion w, x, y, z");
  }
  constexpr double kRounding = 1e-14;
  if (deviation > kRounding) q.normalize();
  return q;
}

}  // namespace ridgeline
