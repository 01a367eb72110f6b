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

}  // namespace

BoxTree BuildBoxTree(const std::vector<Eigen::AlignedBox3f>& boxes, int max_leaf_size) {
  BoxTree tree;
  if (boxes.empty()) return tree;
  std::vector<RTCBuildPrimitive> primitives(boxes.size());
  Eigen::AlignedBox3f all;
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    const Eigen::Vector3f& lower = boxes[i].min();
    const Eigen::Vector3f& upper = boxes[i].max();
    primitives[i] = {lower.x(),
                     lower.y(),
                     lower.z(),
                     0,
                     upper.x(),
                     upper.y(),
                     upper.z(),
                     static_cast<unsigned>(i)};
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

}  // namespace ridgeline
