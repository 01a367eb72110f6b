// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "city/city_model.h"
#include "projection/surface_panorama.h"

namespace ridgeline {

inline constexpr std::uint16_t kSkyGroup = 0;
inline constexpr std::uint16_t kGroundGroup = 1;  // terrain, or below the horizontal behind it
inline constexpr std::uint16_t kFirstBuildingGroup = 2;
inline constexpr std::uint16_t kNoGroup = 0xFFFF;

// The azimuths of horizontal lines on walls, in steps of half a turn.
inline constexpr int kCourses = 360;
inline constexpr std::uint16_t kSlopedCourse = kCourses;  // on a surface that is no upright wall
inline constexpr std::uint16_t kNoCourse = kCourses + 1;  // flat, terrain or sky

// What is seen from a position, told apart as far as colours may differ: the sky, the ground, and
// the walls and the roofs of each building. And how the courses of what is seen run.
struct SurfaceGroups {
  std::vector<std::uint16_t> of_cell;  // by cell of the panorama
  int count = kFirstBuildingGroup;
  // By cell: the nearest multiple of pi / kCourses clockwise from north, or one of the above.
  std::vector<std::uint16_t> courses;
};

// Surfaces whose normals are less horizontal than this have no courses.
inline constexpr float kMinHorizontalNormal = 0.1f;

std::uint16_t CourseOf(const Eigen::Vector3f& normal);

SurfaceGroups GroupsOf(const SurfacePanorama& panorama, const CityModel& model);

}  // namespace ridgeline
