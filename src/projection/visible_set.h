// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

namespace ridgeline {

// What is seen beside an edge, on one side of it.
enum class Beside : std::uint8_t { kSky, kOwnWall, kOwnRoof, kOtherBuilding, kGround };

// A visible part of a model edge, seen from one position. Orientation-free.
struct VisiblePiece {
  Eigen::Vector3f a = Eigen::Vector3f::Zero();  // ends, local frame [m]
  Eigen::Vector3f b = Eigen::Vector3f::Zero();
  // Index into CityModel::feature_edges; beyond its end a fold below the model's least angle that
  // is a silhouette from here (Scene::edge knows both).
  std::uint32_t edge = 0;
  // Seen from the position, walking from a to b with up = +height: what lies to the left and right.
  Beside left = Beside::kSky;
  Beside right = Beside::kSky;
};

// Everything visible from one position, in all directions of a sector. An edge that reaches into
// the sector comes as a whole.
struct VisibleSet {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  // local [m]
  std::vector<VisiblePiece> pieces;                    // ordered by edge, then along the edge
  // Elevation angle [rad] of the skyline (buildings and terrain) at azimuths
  // first_azimuth + i * azimuth_step (clockwise from north) [rad]. At least 0: beyond the model
  // and the terrain the ground goes on to the horizon.
  double first_azimuth = 0.0;
  double azimuth_step = 0.0;
  std::vector<float> skyline_elevation;
};

// Sector of view directions: azimuths clockwise from north, half width pi: all around; elevations
// [rad].
struct Sector {
  double center = 0.0;
  double half_width = 3.14159265358979323846;
  double lowest_elevation = -1.57079632679489661923;
  double highest_elevation = 1.57079632679489661923;
};

}  // namespace ridgeline
