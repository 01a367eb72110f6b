// SPDX-License-Identifier: Apache-2.0
#include "projection/bvh_build.h"

#include <embree3/rtcore.h>

#include <new>
#include <stdexcept>

namespace ridgeline {
namespace {

// A node as Embree's builder hands it out: inner with children, or leaf with primitives.
struct RawNode {
  bool is_leaf = false;
  unsigned count = 0;
  std::array<Eigen::AlignedBox3f, 4> boxes;
  std::array<RawNode*, 4> children{};
  std::array<std::uint32_t, RTC_BUILD_MAX_PRIMITIVES_PER_LEAF> primitives{};
};

RawNode* NewNode(RTCThreadLocalAllocator allocator) {
  return new (rtcThreadLocalAlloc(allocator, sizeof(RawNode), 16)) RawNode;
}

void* CreateNode(RTCThreadLocalAllocator allocator, unsigned, void*) { return NewNode(allocator); }

void SetChildren(void* node, void** children, unsigned count, void*) {
  RawNode& raw = *static_cast<RawNode*>(node);
  raw.count = count;
  for (unsigned i = 0; i < count; ++i) raw.children[i] = static_cast<RawNode*>(children[i]);
}

void SetBounds(void* node, const RTCBounds** bounds, unsigned count, void*) {
  RawNode& raw = *static_cast<RawNode*>(node);
  for (unsigned i = 0; i < count; ++i) {
    const RTCBounds& b = *bounds[i];
    raw.boxes[i] = Eigen::AlignedBox3f(Eigen::Vector3f(b.lower_x, b.lower_y, b.lower_z),
                                       Eigen::Vector3f(b.upper_x, b.upper_y, b.upper_z));
  }
}

void* CreateLeaf(RTCThreadLocalAllocator allocator,
                 const RTCBuildPrimitive* primitives,
                 size_t count,
                 void*) {
  RawNode* const raw = NewNode(allocator);
  raw->is_leaf = true;
  raw->count = static_cast<unsigned>(count);
  for (size_t i = 0; i < count; ++i) raw->primitives[i] = primitives[i].primID;
  return raw;
}

std::int32_t Flatten(const RawNode& raw, BoxTree& tree) {
  if (raw.is_leaf) {
    tree.leaves.push_back({{raw.primitives.begin(), raw.primitives.begin() + raw.count}});
    return ~static_cast<std::int32_t>(tree.leaves.size() - 1);
  }
  const auto index = static_cast<std::int32_t>(tree.nodes.size());
  tree.nodes.emplace_back();
  tree.nodes[index].boxes = raw.boxes;
  for (unsigned i = 0; i < raw.count; ++i) {
    const std::int32_t child = Flatten(*raw.children[i], tree);
    tree.nodes[index].children[i] = child;
  }
  return index;
}

using Corners = std::array<Eigen::Vector3f, 3>;

void SetBounds(const Eigen::AlignedBox3f& box, RTCBounds& bounds) {
  bounds.lower_x = box.min().x();
  bounds.lower_y = box.min().y();
  bounds.lower_z = box.min().z();
  bounds.upper_x = box.max().x();
  bounds.upper_y = box.max().y();
  bounds.upper_z = box.max().z();
}

// Boxes of the parts of a triangle below and above a plane across an axis, within its present box.
void SplitTriangle(const RTCBuildPrimitive* primitive,
                   unsigned axis,
                   float position,
                   RTCBounds* left_bounds,
                   RTCBounds* right_bounds,
                   void* user) {
  const Corners& corners = (*static_cast<const std::vector<Corners>*>(user))[primitive->primID];
  const RTCBuildPrimitive& p = *primitive;
  const Eigen::AlignedBox3f present(Eigen::Vector3f(p.lower_x, p.lower_y, p.lower_z),
                                    Eigen::Vector3f(p.upper_x, p.upper_y, p.upper_z));
  Eigen::AlignedBox3f left, right;
  for (int k = 0; k < 3; ++k) {
    const Eigen::Vector3f& a = corners[k];
    const Eigen::Vector3f& b = corners[(k + 1) % 3];
    if (a[axis] <= position) left.extend(a);
    if (a[axis] >= position) right.extend(a);
    if ((a[axis] < position) == (b[axis] < position)) continue;
    Eigen::Vector3f cut = a + (position - a[axis]) / (b[axis] - a[axis]) * (b - a);
    cut[axis] = position;
    left.extend(cut);
    right.extend(cut);
  }
  // Rounding of the cuts.
  const Eigen::Vector3f margin = Eigen::Vector3f::Constant(1e-3f);
  left = Eigen::AlignedBox3f(left.min() - margin, left.max() + margin).intersection(present);
  right = Eigen::AlignedBox3f(right.min() - margin, right.max() + margin).intersection(present);
  SetBounds(left, *left_bounds);
  SetBounds(right, *right_bounds);
}

BoxTree Build(const std::vector<Eigen::AlignedBox3f>& boxes,
              int max_leaf_size,
              const std::vector<Corners>* triangles) {
  BoxTree tree;
  if (boxes.empty()) return tree;
  std::vector<RTCBuildPrimitive> primitives;
  // Splits need room for more.
  primitives.reserve(triangles == nullptr ? boxes.size() : 2 * boxes.size());
  Eigen::AlignedBox3f all;
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    const Eigen::Vector3f& lower = boxes[i].min();
    const Eigen::Vector3f& upper = boxes[i].max();
    primitives.push_back({lower.x(), lower.y(), lower.z(), 0,
                          upper.x(), upper.y(), upper.z(), static_cast<unsigned>(i)});
    all.extend(boxes[i]);
  }
  // One build thread: the tree, and so every tie in its use, is the same in each run.
  const RTCDevice device = rtcNewDevice("threads=1");
  const RTCBVH bvh = rtcNewBVH(device);
  RTCBuildArguments arguments = rtcDefaultBuildArguments();
  arguments.maxBranchingFactor = 4;
  arguments.maxDepth = 64;
  arguments.minLeafSize = 1;
  arguments.maxLeafSize = static_cast<unsigned>(max_leaf_size);
  arguments.sahBlockSize = static_cast<unsigned>(max_leaf_size);
  arguments.bvh = bvh;
  arguments.primitives = primitives.data();
  arguments.primitiveCount = primitives.size();
  arguments.primitiveArrayCapacity = primitives.capacity();
  arguments.createNode = CreateNode;
  arguments.setNodeChildren = SetChildren;
  arguments.setNodeBounds = SetBounds;
  arguments.createLeaf = CreateLeaf;
  if (triangles != nullptr) {
    arguments.buildQuality = RTC_BUILD_QUALITY_HIGH;
    arguments.splitPrimitive = SplitTriangle;
    arguments.userPtr = const_cast<std::vector<Corners>*>(triangles);
  }
  const auto* const root = static_cast<const RawNode*>(rtcBuildBVH(&arguments));
  if (root != nullptr && root->is_leaf) {
    tree.nodes.emplace_back();
    tree.nodes[0].boxes[0] = all;
    tree.nodes[0].children[0] = Flatten(*root, tree);
  } else if (root != nullptr) {
    Flatten(*root, tree);
  }
  rtcReleaseBVH(bvh);
  rtcReleaseDevice(device);
  if (root == nullptr) throw std::runtime_error("the bounding volume hierarchy cannot be built");
  return tree;
}

}  // namespace

BoxTree BuildBoxTree(const std::vector<Eigen::AlignedBox3f>& boxes, int max_leaf_size) {
  return Build(boxes, max_leaf_size, nullptr);
}

BoxTree BuildTriangleTree(const std::vector<std::array<Eigen::Vector3f, 3>>& triangles,
                          int max_leaf_size) {
  std::vector<Eigen::AlignedBox3f> boxes(triangles.size());
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    for (const Eigen::Vector3f& corner : triangles[i]) boxes[i].extend(corner);
  }
  return Build(boxes, max_leaf_size, &triangles);
}

}  // namespace ridgeline
