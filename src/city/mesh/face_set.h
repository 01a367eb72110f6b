// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

#include "city/city_model.h"

namespace ridgeline {

// A polygon of the mesh with its rings: what is between the readers and CityModel, and what
// orientation and feature edges are computed from.
struct Face {
  std::uint32_t first_ring = 0;  // the outer ring, then the holes
  std::uint32_t ring_count = 0;
  std::uint32_t building = 0;
  SurfaceClass surface_class = SurfaceClass::kOther;
  bool has_class = false;
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();    // unit, of Newell's formula
  Eigen::Vector3d centroid = Eigen::Vector3d::Zero();  // of the outer ring's corners
  double area = 0.0;
};

struct FaceRing {
  std::uint32_t first = 0;
  std::uint32_t count = 0;
};

// Outer rings run counter-clockwise about the normal, holes clockwise.
struct FaceSet {
  std::vector<Eigen::Vector3d> vertices;  // local frame [m], welded
  std::vector<std::uint32_t> corners;     // vertex indices of all rings
  std::vector<FaceRing> rings;
  std::vector<Face> faces;

  std::span<const std::uint32_t> Ring(std::uint32_t ring) const {
    return std::span(corners).subspan(rings[ring].first, rings[ring].count);
  }
  // Turns a face around.
  void Flip(Face& face);
};

// Newell's normal of a ring; its length is twice the area.
Eigen::Vector3d NewellNormal(const FaceSet& set, std::span<const std::uint32_t> ring);

}  // namespace ridgeline
