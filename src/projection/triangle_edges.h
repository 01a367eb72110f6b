// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "city/city_model.h"

namespace ridgeline {

// Undirected edge between two vertices of the model and the triangles at it.
struct TriangleEdge {
  std::uint32_t v0 = 0;  // v0 < v1
  std::uint32_t v1 = 0;
  std::uint32_t first = 0;  // its triangles: TriangleEdges::sides[first, first + count)
  std::uint32_t count = 0;
};

// A triangle at an edge.
struct TriangleSide {
  std::uint32_t triangle = 0;
  std::uint32_t opposite = 0;  // its third vertex
  bool forward = true;         // whether it runs from v0 to v1
};

struct TriangleEdges {
  std::vector<TriangleEdge> edges;  // ordered by (v0, v1)
  std::vector<TriangleSide> sides;

  // The edge between two vertices; nullptr: none.
  const TriangleEdge* Find(std::uint32_t a, std::uint32_t b) const;
};

// Triangles with two equal vertices are left out.
TriangleEdges FindTriangleEdges(const CityModel& model);

// Per building, the building it is a part of; itself if it is none.
std::vector<std::uint32_t> RootBuildings(const CityModel& model);

// Per building, whether its triangles, or those of all parts of its root, close a shell: every edge
// is run through as often in one direction as in the other, and the volume is positive.
std::vector<char> ClosedBuildings(const CityModel& model, const TriangleEdges& edges);

}  // namespace ridgeline
