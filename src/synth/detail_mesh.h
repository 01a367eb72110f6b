// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

#include "synth/town.h"

namespace ridgeline {

enum class Material : std::uint8_t { kFacade, kRoof, kPlain, kGlossy, kGround, kLeaves };

// A wall as the facade painter sees it; uv of its triangles: metres along the wall from its left
// end, metres above the ground floor.
struct WallLook {
  float length_m = 0.0f;
  float storey_m = 3.0f;
  int storeys = 1;
  bool faces_street = false;
  std::uint64_t look = 0;  // of the building
  std::uint64_t side = 0;  // of this wall
};

struct DetailTriangle {
  std::array<std::uint32_t, 3> vertices{};
  Material material = Material::kPlain;
  std::uint32_t wall = 0;                                   // kFacade: index into walls
  Eigen::Vector3f color = Eigen::Vector3f::Constant(0.5f);  // albedo of all other materials
};

// What a photo of the town shows: the buildings as built, ground, trees, cars, lamps, people.
struct DetailMesh {
  std::vector<Eigen::Vector3f> vertices;  // local frame [m]
  std::vector<Eigen::Vector2f> uv;        // per vertex
  std::vector<DetailTriangle> triangles;
  std::vector<WallLook> walls;

  // A convex polygon, counter-clockwise from outside, as a fan. uv may be empty.
  void AddPolygon(std::span<const Eigen::Vector3d> ring,
                  std::span<const Eigen::Vector2d> ring_uv,
                  const DetailTriangle& look);
  // A frustum on a rectangle: `center` of its lower face, unit vector `along`, size at the bottom
  // and at the top.
  void AddFrustum(const Eigen::Vector3d& center,
                  const Eigen::Vector2d& along,
                  const Eigen::Vector2d& lower_size,
                  const Eigen::Vector2d& upper_size,
                  double height_m,
                  const DetailTriangle& look);
};

// Walls, overhanging roofs, chimneys and dormers of all buildings.
void AddBuildings(const Town& town, double overhang_m, DetailMesh& mesh);
// Terrain: 1 m under the town, coarse and hillier up to 2 km around it.
void AddGround(const Town& town, DetailMesh& mesh);
// Trees, parked cars, lamps and people along the streets, trees in the yards.
void AddStreetLife(const Town& town, DetailMesh& mesh);

}  // namespace ridgeline
