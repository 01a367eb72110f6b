// SPDX-License-Identifier: Apache-2.0
#include "projection/occluder_bvh.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <numbers>

#include "projection/bvh_build.h"
#include "projection/occluder_leaf.h"
#include "projection/simd4.h"

namespace ridgeline {
namespace {

using simd::Abs;
using simd::Dot;
using simd::Float4;
using simd::Max;
using simd::Splat;
using simd::Vec3x4;

// Shadows of neighbouring triangles meet within the rounding of floats.
constexpr float kJoin = 4e-6f;

// An empty place in a node: this negative extent is outside of everything.
constexpr float kNoBox = 1e12f;

struct Node {
  Vec3x4 center;
  Vec3x4 extent;
  std::array<std::int32_t, 4> children;
};

// A plane through the eye (or, with an offset, beside it) and the reach of boxes across it.
struct Halfspace {
  Vec3x4 normal;
  Vec3x4 reach;

  explicit Halfspace(const Eigen::Vector3f& n) : normal(Splat(n)), reach(Abs(normal)) {}
  // Largest value of normal * x over the boxes.
  Float4 Highest(const Vec3x4& center, const Vec3x4& extent) const {
    return Dot(normal, center) + Dot(reach, extent);
  }
  // Distance of the boxes from the plane, <= 0 if they touch it.
  Float4 Distance(const Vec3x4& center, const Vec3x4& extent) const {
    return Abs(Dot(normal, center)) - Dot(reach, extent);
  }
};

// The plane triangle eye, a, b: the region in which something can hide a part of a-b.
struct Wedge {
  Halfspace plane, side_a, side_b, behind;
  Float4 behind_offset;

  Wedge(const Eigen::Vector3f& a, const Eigen::Vector3f& b, const Eigen::Vector3f& normal)
      : plane(normal),
        side_a(normal.cross(a)),
        side_b(b.cross(normal)),
        behind(BehindNormal(a, b, normal)) {
    behind_offset = Splat(BehindNormal(a, b, normal).dot(a));
  }

  // Points towards the eye, across the line a-b in the wedge's plane.
  static Eigen::Vector3f BehindNormal(const Eigen::Vector3f& a,
                                      const Eigen::Vector3f& b,
                                      const Eigen::Vector3f& normal) {
    const Eigen::Vector3f n = normal.cross(b - a);
    return n.dot(a) > 0.0f ? Eigen::Vector3f(-n) : n;
  }

  // > 0 for boxes that lie outside.
  Float4 Outside(const Vec3x4& center, const Vec3x4& extent) const {
    const Float4 across = plane.Distance(center, extent);
    const Float4 before_a = -side_a.Highest(center, extent);
    const Float4 after_b = -side_b.Highest(center, extent);
    const Float4 beyond = behind_offset - behind.Highest(center, extent);
    return Max(Max(across, beyond), Max(before_a, after_b));
  }
};

void AddHidden(Interval added, std::vector<Interval>& hidden) {
  std::size_t begin = 0;
  while (begin < hidden.size() && hidden[begin].last < added.first - kJoin) ++begin;
  std::size_t end = begin;
  while (end < hidden.size() && hidden[end].first <= added.last + kJoin) {
    added.first = std::min(added.first, hidden[end].first);
    added.last = std::max(added.last, hidden[end].last);
    ++end;
  }
  if (begin == end) {
    hidden.insert(hidden.begin() + static_cast<std::ptrdiff_t>(begin), added);
    return;
  }
  hidden[begin] = added;
  hidden.erase(hidden.begin() + static_cast<std::ptrdiff_t>(begin) + 1,
               hidden.begin() + static_cast<std::ptrdiff_t>(end));
}

// Index of a direction among `count` ranges around the vertical axis, without trigonometry.
std::size_t AzimuthRange(const Eigen::Vector3f& p, std::size_t count) {
  const float sum = std::abs(p.x()) + std::abs(p.y());
  if (!(sum > 0.0f)) return 0;
  const float quarter = p.y() / sum;                                   // [-1, 1]
  const float turn = p.x() >= 0.0f ? 1.0f - quarter : 3.0f + quarter;  // [0, 4]
  return std::min(count - 1, static_cast<std::size_t>(turn * 0.25f * static_cast<float>(count)));
}

bool HasGap(const std::vector<Interval>& hidden, float min_part) {
  float start = 0.0f;
  for (const Interval& part : hidden) {
    if (part.first - start >= min_part) return true;
    start = part.last;
  }
  return 1.0f - start >= min_part;
}

// A rotation about the vertical axis.
struct Turn {
  float cosine = 1.0f;
  float sine = 0.0f;

  Eigen::Vector3f operator*(const Eigen::Vector3f& p) const {
    return {cosine * p.x() - sine * p.y(), sine * p.x() + cosine * p.y(), p.z()};
  }
};

// Boxes fit walls that run along the axes. Of 18 rotations the one with the smallest boxes: streets
// are often at right angles, seldom to the north.
Turn TurnToAxes(const std::vector<Occluder>& occluders) {
  Turn best;
  double least = std::numeric_limits<double>::infinity();
  for (int k = 0; k < 18; ++k) {
    const double angle = k * 5.0 * std::numbers::pi / 180.0;
    const Turn turn{static_cast<float>(std::cos(angle)), static_cast<float>(std::sin(angle))};
    double area = 0.0;
    for (const Occluder& o : occluders) {
      Eigen::AlignedBox3f box;
      box.extend(turn * o.a).extend(turn * o.b).extend(turn * o.c).extend(turn * o.d);
      const Eigen::Vector3f size = box.sizes();
      area += size.x() * size.y() + size.y() * size.z() + size.z() * size.x();
    }
    if (area < least) {
      least = area;
      best = turn;
    }
  }
  return best;
}

}  // namespace

struct OccluderBvh::Impl {
  Turn turn;
  std::vector<Node> nodes;
  std::vector<OccluderLeaf> leaves;
};

namespace {

Node MakeNode(const BoxTree::Node& source) {
  Node node{};
  node.children = source.children;
  for (int k = 0; k < 4; ++k) {
    if (source.children[k] == BoxTree::kNone) {
      simd::SetLane(node.extent, k, Eigen::Vector3f::Constant(-kNoBox));
      continue;
    }
    simd::SetLane(node.center, k, source.boxes[k].center());
    // A millimetre against rounding; flat boxes are common.
    simd::SetLane(node.extent, k, (source.boxes[k].sizes() * 0.5f).array() + 1e-3f);
  }
  return node;
}

}  // namespace

OccluderBvh::OccluderBvh(std::vector<Occluder> occluders) : impl_(std::make_unique<Impl>()) {
  impl_->turn = TurnToAxes(occluders);
  std::vector<Eigen::AlignedBox3f> boxes(occluders.size());
  for (std::size_t i = 0; i < occluders.size(); ++i) {
    Occluder& o = occluders[i];
    for (Eigen::Vector3f* corner : {&o.a, &o.b, &o.c, &o.d}) {
      *corner = impl_->turn * *corner;
      boxes[i].extend(*corner);
    }
  }
  const BoxTree tree = BuildBoxTree(boxes, 4);
  impl_->nodes.reserve(tree.nodes.size());
  for (const BoxTree::Node& node : tree.nodes) impl_->nodes.push_back(MakeNode(node));
  impl_->leaves.reserve(tree.leaves.size());
  for (const BoxTree::Leaf& leaf : tree.leaves) {
    impl_->leaves.emplace_back(leaf.primitives, occluders);
  }
}

OccluderBvh::~OccluderBvh() = default;

std::size_t OccluderBvh::memory_bytes() const {
  return impl_->nodes.size() * sizeof(Node) + impl_->leaves.size() * sizeof(OccluderLeaf);
}

bool OccluderBvh::HidesBox(const Eigen::Vector3f& eye,
                           const Eigen::Vector3f& center_from_eye,
                           const Eigen::Vector3f& extent,
                           const Hints& hints) const {
  const Turn& turn = impl_->turn;
  const Eigen::Vector3f center = turn * center_from_eye;
  const std::uint32_t hint = hints[AzimuthRange(center, hints.size())];
  if (hint >= impl_->leaves.size()) return false;
  // The box around the turned box; a millimetre keeps rounding on the safe side.
  const float c = std::abs(turn.cosine);
  const float s = std::abs(turn.sine);
  const Eigen::Vector3f turned(c * extent.x() + s * extent.y() + 1e-3f,
                               s * extent.x() + c * extent.y() + 1e-3f,
                               extent.z() + 1e-3f);
  return ShadowHoldsBox(impl_->leaves[hint], Splat(turn * eye), Splat(center), Splat(turned));
}

bool OccluderBvh::Hide(const Eigen::Vector3f& eye,
                       const Eigen::Vector3f& a_from_eye,
                       const Eigen::Vector3f& b_from_eye,
                       float min_part,
                       std::vector<Interval>& hidden,
                       Hints& hints) const {
  const Eigen::Vector3f a = impl_->turn * a_from_eye;
  const Eigen::Vector3f b = impl_->turn * b_from_eye;
  const Eigen::Vector3f normal = a.cross(b);
  if (normal.squaredNorm() == 0.0f) return false;  // seen from its end: a point
  if (impl_->nodes.empty()) return true;
  const Vec3x4 eye4 = Splat(impl_->turn * eye);
  const Vec3x4 a4 = Splat(a);
  const Vec3x4 b4 = Splat(b);
  std::uint32_t& hint = hints[AzimuthRange(a + b, hints.size())];
  std::uint32_t& hint_a = hints[AzimuthRange(a, hints.size())];
  std::uint32_t& hint_b = hints[AzimuthRange(b, hints.size())];

  // Returns false when nothing is left of the segment.
  const auto cast_leaf = [&](std::uint32_t index) {
    const Shadows shadows = CastShadows(impl_->leaves[index], eye4, a4, b4);
    if (shadows.all) {
      hint = hint_a = hint_b = index;
      return false;
    }
    if (shadows.some == 0) return true;
    for (unsigned found = shadows.some; found != 0; found &= found - 1) {
      const int k = std::countr_zero(found);
      AddHidden({shadows.first[k], shadows.last[k]}, hidden);
      if (shadows.first[k] <= 0.0f) hint_a = index;
      if (shadows.last[k] >= 1.0f) hint_b = index;
    }
    if (HasGap(hidden, min_part)) return true;
    hint = index;
    return false;
  };

  if (hint < impl_->leaves.size() && !cast_leaf(hint)) return false;
  if (hint_a < impl_->leaves.size() && !cast_leaf(hint_a)) return false;
  if (hint_b < impl_->leaves.size() && !cast_leaf(hint_b)) return false;

  const Wedge wedge(a, b, normal.normalized());
  struct Entry {
    float distance2;
    std::int32_t child;
  };
  std::array<Entry, 256> stack;
  std::size_t size = 0;
  stack[size++] = {0.0f, 0};
  while (size > 0) {
    const std::int32_t child = stack[--size].child;
    if (child < 0) {
      if (!cast_leaf(static_cast<std::uint32_t>(~child))) return false;
      continue;
    }
    const Node& node = impl_->nodes[child];
    const Vec3x4 center = node.center - eye4;
    const Float4 outside = wedge.Outside(center, node.extent);
    const Float4 zero = Splat(0.0f);
    const Vec3x4 gap{Max(Abs(center.x) - node.extent.x, zero),
                     Max(Abs(center.y) - node.extent.y, zero),
                     Max(Abs(center.z) - node.extent.z, zero)};
    const Float4 distance2 = Dot(gap, gap);
    // Insertion keeps the nearest child on top of the stack.
    const std::size_t bottom = size;
    for (unsigned inside = simd::Bits(outside <= 0.0f); inside != 0; inside &= inside - 1) {
      const int k = std::countr_zero(inside);
      const Entry entry{distance2[k], node.children[k]};
      std::size_t place = size++;
      while (place > bottom && stack[place - 1].distance2 < entry.distance2) {
        stack[place] = stack[place - 1];
        --place;
      }
      stack[place] = entry;
    }
  }
  return true;
}

}  // namespace ridgeline
