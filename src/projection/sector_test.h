// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace ridgeline {

// Whether segments and boxes (relative to the eye) may reach into a sector of azimuths, clockwise
// from north, and elevations [rad]. Never says no to something that does.
class SectorTest {
 public:
  // All elevations.
  SectorTest(double center, double half_width)
      : SectorTest(center, half_width, -std::numbers::pi / 2, std::numbers::pi / 2) {}

  SectorTest(double center, double half_width, double lowest_elevation, double highest_elevation)
      : all_(half_width >= std::numbers::pi),
        narrow_(half_width <= std::numbers::pi / 2),
        // Inward normals of the two limits.
        left_(static_cast<float>(std::cos(center - half_width)),
              static_cast<float>(-std::sin(center - half_width))),
        right_(static_cast<float>(-std::cos(center + half_width)),
               static_cast<float>(std::sin(center + half_width))),
        has_lowest_(lowest_elevation > -kAlmostVertical),
        has_highest_(highest_elevation < kAlmostVertical),
        lowest_slope_(static_cast<float>(has_lowest_ ? std::tan(lowest_elevation) : 0.0)),
        highest_slope_(static_cast<float>(has_highest_ ? std::tan(highest_elevation) : 0.0)) {}

  bool MayContainSegment(const Eigen::Vector3f& a, const Eigen::Vector3f& b) const {
    if (!all_) {
      const bool beyond_left = left_.dot(a.head<2>()) < 0 && left_.dot(b.head<2>()) < 0;
      const bool beyond_right = right_.dot(a.head<2>()) < 0 && right_.dot(b.head<2>()) < 0;
      if (narrow_ ? beyond_left || beyond_right : beyond_left && beyond_right) return false;
    }
    if (!has_lowest_ && !has_highest_) return true;
    const float at_a = a.head<2>().norm();
    const float at_b = b.head<2>().norm();
    const float length = (b - a).head<2>().norm();
    return MayReach(std::min(a.z(), b.z()),
                    std::max(a.z(), b.z()),
                    std::max(0.0f, 0.5f * (at_a + at_b - length)),
                    std::max(at_a, at_b));
  }

  bool MayContainBox(const Eigen::Vector3f& center, const Eigen::Vector3f& extent) const {
    if (!all_) {
      const bool beyond_left = Highest(left_, center, extent) < 0;
      const bool beyond_right = Highest(right_, center, extent) < 0;
      if (narrow_ ? beyond_left || beyond_right : beyond_left && beyond_right) return false;
    }
    if (!has_lowest_ && !has_highest_) return true;
    const float distance = center.head<2>().norm();
    const float radius = extent.head<2>().norm();
    return MayReach(center.z() - extent.z(),
                    center.z() + extent.z(),
                    std::max(0.0f, distance - radius),
                    distance + radius);
  }

 private:
  static constexpr double kAlmostVertical = 1.5;  // [rad]

  // Points between two heights and between two horizontal distances.
  bool MayReach(float lower, float upper, float nearest, float farthest) const {
    if (has_highest_ && lower > highest_slope_ * (highest_slope_ > 0 ? farthest : nearest)) {
      return false;
    }
    return !(has_lowest_ && upper < lowest_slope_ * (lowest_slope_ > 0 ? nearest : farthest));
  }

  static float Highest(const Eigen::Vector2f& normal,
                       const Eigen::Vector3f& center,
                       const Eigen::Vector3f& extent) {
    return normal.dot(center.head<2>()) + normal.cwiseAbs().dot(extent.head<2>());
  }

  bool all_;
  bool narrow_;
  Eigen::Vector2f left_;
  Eigen::Vector2f right_;
  bool has_lowest_;
  bool has_highest_;
  float lowest_slope_;
  float highest_slope_;
};

}  // namespace ridgeline
