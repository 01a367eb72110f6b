// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace ridgeline {

// A polygon with holes in its own plane: points of the outer ring (counter-clockwise), then of the
// holes (clockwise); ring r has the points [ring_ends[r - 1], ring_ends[r]).
struct PlanarPolygon {
  std::vector<Eigen::Vector2d> points;
  std::vector<std::uint32_t> ring_ends;
};

// Indices into PlanarPolygon::points; counter-clockwise.
using TriangleIndices = std::array<std::uint32_t, 3>;

// Ear clipping with holes joined to the outer ring by bridges (D. Eberly, Triangulation by ear
// clipping, 2002). Touching rings, repeated points and collinear points are fine. Of a ring that
// crosses itself it makes what it can: compare Area of the triangles with SignedArea.
std::vector<TriangleIndices> Triangulate(const PlanarPolygon& polygon);

// Area of a ring by the shoelace formula, positive if counter-clockwise.
double SignedArea(std::span<const Eigen::Vector2d> ring);

// Twice the signed area of the triangle a, b, c.
inline double Cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c) {
  return (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x());
}

}  // namespace ridgeline
