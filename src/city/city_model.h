// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace ridgeline {

enum class SurfaceClass : std::uint8_t { kWall, kRoof, kGround, kClosure, kOther, kTerrain };

// A building or building part.
struct Building {
  std::string id;         // gml:id, or "building-<n>" where the file gives none
  std::string parent_id;  // of a building part; empty otherwise
};

// One polygon of the model: its triangles share class, building and plane.
struct Surface {
  SurfaceClass surface_class = SurfaceClass::kOther;
  std::uint32_t building = 0;                        // index into CityModel::buildings
  Eigen::Vector3f normal = Eigen::Vector3f::Zero();  // outward, unit
};

// Triangle of vertex indices, counter-clockwise seen from outside.
struct Triangle {
  std::array<std::uint32_t, 3> vertices{};
  std::uint32_t surface = 0;
};

inline constexpr std::uint32_t kNoSurface = 0xFFFFFFFFu;

// Edge of the model that can be seen as a line: a fold between two planes, or the border of a
// surface without neighbour. Edges between coplanar polygons, inside walls that adjoining buildings
// share, and along the cuts of tiles are not feature edges. Where the coplanar walls or roofs of
// two different buildings meet there is no fold, but often a change of colour: a seam. Edges at the
// foot of a wall have a ground surface on one side (or none, where the model has no ground
// surfaces).
struct FeatureEdge {
  Eigen::Vector3d a = Eigen::Vector3d::Zero();  // local frame [m]
  Eigen::Vector3d b = Eigen::Vector3d::Zero();
  std::uint32_t surface0 = kNoSurface;
  std::uint32_t surface1 = kNoSurface;  // kNoSurface: a border
  bool seam = false;                    // no fold: coplanar surfaces of two buildings meet
};

// Reference system of a model, DTM or dataset: EPSG codes; vertical 0 is not known.
struct Crs {
  int horizontal_epsg = 0;
  int vertical_epsg = 0;
};

// The buildings of one or more files in one local frame (east, north, height; metres).
struct CityModel {
  Crs crs;
  Eigen::Vector3d origin_in_world = Eigen::Vector3d::Zero();  // local = world - origin; rounded
  std::vector<Eigen::Vector3d> vertices;                      // local, welded
  std::vector<Triangle> triangles;
  std::vector<Surface> surfaces;
  std::vector<Building> buildings;
  std::vector<FeatureEdge> feature_edges;
  std::vector<std::string> warnings;  // what was dropped or repaired, by name and count
};

}  // namespace ridgeline
