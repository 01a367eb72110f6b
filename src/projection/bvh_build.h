// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <vector>

namespace ridgeline {

// Hierarchy of boxes with up to four children per node, node 0 the root.
struct BoxTree {
  // Index of a child: a node, or ~leaf for a leaf; kNone: no child.
  static constexpr std::int32_t kNone = INT32_MAX;

  struct Node {
    std::array<Eigen::AlignedBox3f, 4> boxes;
    std::array<std::int32_t, 4> children{kNone, kNone, kNone, kNone};
  };
  // Up to max_leaf_size primitives.
  struct Leaf {
    std::vector<std::uint32_t> primitives;
  };

  std::vector<Node> nodes;
  std::vector<Leaf> leaves;
};

// Surface area heuristic (Embree's builder). Empty input gives no nodes.
BoxTree BuildBoxTree(const std::vector<Eigen::AlignedBox3f>& boxes, int max_leaf_size);

}  // namespace ridgeline
