// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "city/mesh/face_set.h"

namespace ridgeline {

// An edge of one or more polygons, between two welded vertices.
struct PolygonEdge {
  std::uint32_t a = 0;
  std::uint32_t b = 0;
  std::uint32_t first_use = 0;  // of EdgeTable::uses
  std::uint32_t use_count = 0;
};

struct EdgeUse {
  std::uint32_t face = 0;
  bool forward =
      false;  // the face has it from a to b: its interior is to the left about its normal
};

struct EdgeTable {
  std::vector<PolygonEdge> edges;
  std::vector<EdgeUse> uses;
  std::vector<std::uint32_t> edge_of_corner;  // parallel to FaceSet::corners
};

// The distinct edges of all rings, in order of their first appearance.
EdgeTable BuildEdgeTable(const FaceSet& set);

}  // namespace ridgeline
