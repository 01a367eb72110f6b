// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <numbers>

namespace ridgeline {

// Whether segments and boxes (relative to the eye) may reach into a horizontal sector of azimuths,
// clockwise from north [rad]. Never says no to something that does.
class SectorTest {
 public:
  SectorTest(double center, double half_width)
      : all_(half_width >= std::numbers::pi),
        narrow_(half_width <= std::numbers::pi / 2),
        // Inward normals of the two limits.
        left_(static_cast<float>(std::cos(center - half_width)),
              static_cast<float>(-std::sin(center - half_width))),
        right_(static_cast<float>(-std::cos(center + half_width)),
               static_cast<float>(std::sin(center + half_width))) {}

  bool MayContainSegment(const Eigen::Vector3f& a, const Eigen::Vector3f& b) const {
    if (all_) return true;
    const bool beyond_left = left_.dot(a.head<2>()) < 0 && left_.dot(b.head<2>()) < 0;
    const bool beyond_right = right_.dot(a.head<2>()) < 0 && right_.dot(b.head<2>()) < 0;
    return narrow_ ? !(beyond_left || beyond_right) : !(beyond_left && beyond_right);
  }

  bool MayContainBox(const Eigen::Vector3f& center, const Eigen::Vector3f& extent) const {
    if (all_) return true;
    const bool beyond_left = Highest(left_, center, extent) < 0;
    const bool beyond_right = Highest(right_, center, extent) < 0;
    return narrow_ ? !(beyond_left || beyond_right) : !(beyond_left && beyond_right);
  }

 private:
  static float Highest(const Eigen::Vector2f& normal,
                       const Eigen::Vector3f& center,
                       const Eigen::Vector3f& extent) {
    return normal.dot(center.head<2>()) + normal.cwiseAbs().dot(extent.head<2>());
  }

  bool all_;
  bool narrow_;
  Eigen::Vector2f left_;
  Eigen::Vector2f right_;
};

}  // namespace ridgeline
