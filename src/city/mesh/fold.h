// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "city/mesh/face_set.h"

namespace ridgeline {

// A face as seen at a piece of an edge: it leaves the edge's line in direction `angle`.
struct HalfPlane {
  std::uint32_t face = 0;
  double angle = 0.0;      // about the line, in the frame of the edge
  double free_side = 0.0;  // +1: the free space is at larger angles, -1: at smaller ones
};

// Removes faces that hide each other: back to back (both), or one on the other (one of them).
void RemoveHidden(const FaceSet& set, std::vector<HalfPlane>& planes);

struct Fold {
  std::size_t first = 0;
  std::size_t second = 0;
  double angle = 0.0;
};

// Of the wedges of free space between consecutive faces, the one that is least flat. Sorts the
// faces by angle; there must be two or more.
Fold SharpestFold(std::vector<HalfPlane>& planes);

}  // namespace ridgeline
