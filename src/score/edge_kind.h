// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>

#include "projection/scene.h"

namespace ridgeline {

// What an edge separates in the picture. How often an edge is seen in real pictures depends on it.
enum class EdgeKind : std::uint8_t {
  kSkyline,    // building against sky
  kOcclusion,  // building against another building, or a wall before the ground behind it
  kFold,       // two faces of one building: corner, eaves or ridge seen from inside its outline
  kGround,     // foot of a wall
  kSeam,       // adjoining facades in one plane
};
inline constexpr int kEdgeKinds = 5;
// In the order of EdgeKind; those of their cues.
inline constexpr std::array<const char*, kEdgeKinds> kEdgeKindNames = {
    "skyline_edges", "occlusions", "folds", "ground_lines", "seams"};

EdgeKind KindOf(const VisiblePiece& piece, const Scene& scene);

}  // namespace ridgeline
