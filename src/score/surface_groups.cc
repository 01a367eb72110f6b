// SPDX-License-Identifier: Apache-2.0
#include "score/surface_groups.h"

#include <cmath>
#include <numbers>
#include <unordered_map>

#include "projection/fast_angle.h"

namespace ridgeline {
namespace {

// Surfaces whose normal rises more than this are roofs.
constexpr float kRoofNormal = 0.25f;
// Walls whose normals rise less than this are upright.
constexpr float kUprightNormal = 0.01f;

bool IsGround(const Surface& surface) {
  return surface.surface_class == SurfaceClass::kGround ||
         surface.surface_class == SurfaceClass::kTerrain;
}

}  // namespace

std::uint16_t CourseOf(const Eigen::Vector3f& normal) {
  if (normal.head<2>().squaredNorm() < kMinHorizontalNormal * kMinHorizontalNormal) {
    return kNoCourse;
  }
  if (std::abs(normal.z()) > kUprightNormal) return kSlopedCourse;
  constexpr float kPerRad = kCourses * std::numbers::inv_pi_v<float>;
  const int course =
      static_cast<int>(std::lround(FastAzimuth(-normal.y(), normal.x()) * kPerRad)) + kCourses;
  return static_cast<std::uint16_t>(course % kCourses);
}

SurfaceGroups GroupsOf(const SurfacePanorama& panorama, const CityModel& model) {
  SurfaceGroups groups;
  groups.of_cell.reserve(panorama.surfaces.size());
  groups.courses.reserve(panorama.surfaces.size());
  std::unordered_map<std::uint32_t, std::uint16_t> of_key;
  std::uint32_t last_surface = kTerrainSurface;
  std::uint16_t last_group = kGroundGroup;
  std::uint16_t last_course = kNoCourse;
  const auto group_of = [&](std::uint32_t index) -> std::uint16_t {
    if (index == kTerrainSurface) return kGroundGroup;
    const Surface& surface = model.surfaces[index];
    if (IsGround(surface)) return kGroundGroup;
    const std::uint32_t key = 2 * surface.building + (surface.normal.z() > kRoofNormal ? 1 : 0);
    const auto [entry, is_new] = of_key.try_emplace(key, static_cast<std::uint16_t>(groups.count));
    if (is_new && groups.count < kNoGroup) ++groups.count;
    return entry->second;
  };
  for (int row = 0; row < panorama.rows; ++row) {
    // Beyond the model and the terrain the ground goes on to the horizon.
    const bool is_upward = panorama.first_elevation + row * panorama.step > 0.0;
    for (int column = 0; column < panorama.columns; ++column) {
      const std::uint32_t surface = panorama.surfaces[groups.of_cell.size()];
      if (surface == kNoSurface) {
        groups.of_cell.push_back(is_upward ? kSkyGroup : kGroundGroup);
        groups.courses.push_back(kNoCourse);
        continue;
      }
      if (surface != last_surface) {
        last_surface = surface;
        last_group = group_of(surface);
        last_course =
            surface == kTerrainSurface ? kNoCourse : CourseOf(model.surfaces[surface].normal);
      }
      groups.of_cell.push_back(last_group);
      groups.courses.push_back(last_course);
    }
  }
  return groups;
}

}  // namespace ridgeline
