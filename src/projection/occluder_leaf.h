// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "projection/occluder_bvh.h"
#include "projection/simd4.h"

namespace ridgeline {

// Four occluders side by side.
struct OccluderLeaf {
  simd::Vec3x4 a{}, b{}, c{}, d{};
  simd::Vec3x4 normal{};  // unit; zero for a degenerate occluder and an unused place
  simd::Float4 tolerance{};

  // Up to four of the occluders, by their indices.
  OccluderLeaf(std::span<const std::uint32_t> indices, std::span<const Occluder> occluders);
};

// What a leaf's occluders hide of a segment, one per lane.
struct Shadows {
  unsigned some = 0;  // bit k: occluder k hides the part [first[k], last[k]]
  bool all = false;   // one of them hides all
  simd::Float4 first{};
  simd::Float4 last{};
};

// Values going linearly from the first to the second end of a segment; hidden is where all are >=
// 0.
struct Linear {
  simd::Float4 at_a, at_b;
};

// @param eye  The eye four times; a, b: the segment's ends relative to it, four times each.
inline Shadows CastShadows(const OccluderLeaf& leaf,
                           const simd::Vec3x4& eye,
                           const simd::Vec3x4& a,
                           const simd::Vec3x4& b) {
  using namespace simd;
  const Vec3x4 va = leaf.a - eye;
  const Float4 height = Dot(leaf.normal, va);
  const Float4 sign = height > 0.0f ? Splat(1.0f) : Splat(-1.0f);
  std::array<Linear, 5> values;
  // Behind the plane, as seen from the eye. Most occluders met are the segment's own faces and its
  // neighbours: not in front of it.
  const Float4 depth = Abs(height) + leaf.tolerance;
  values[0] = {sign * Dot(leaf.normal, a) - depth, sign * Dot(leaf.normal, b) - depth};
  Float4 highest = Max(values[0].at_a, values[0].at_b);
  if (simd::Bits(highest > 0.0f) == 0) return Shadows{};
  // Inside the planes through the eye and the sides.
  const Vec3x4 vb = leaf.b - eye;
  const Vec3x4 vc = leaf.c - eye;
  const Vec3x4 vd = leaf.d - eye;
  const std::array<Vec3x4, 4> sides{Cross(va, vb), Cross(vb, vc), Cross(vc, vd), Cross(vd, va)};
  Float4 lowest = Min(values[0].at_a, values[0].at_b);
  for (int k = 0; k < 4; ++k) {
    const Linear value{sign * Dot(sides[k], a), sign * Dot(sides[k], b)};
    lowest = Min(lowest, Min(value.at_a, value.at_b));
    highest = Min(highest, Max(value.at_a, value.at_b));
    values[k + 1] = value;
  }
  Shadows shadows;
  shadows.all = simd::Bits(lowest >= 0.0f) != 0;
  if (shadows.all || simd::Bits(highest >= 0.0f) == 0) return shadows;
  shadows.first = Splat(0.0f);
  shadows.last = Splat(1.0f);
  for (const Linear& value : values) {
    const Float4 zero = value.at_a / (value.at_a - value.at_b);
    shadows.first = Max(shadows.first, value.at_a < 0.0f ? zero : Splat(0.0f));
    shadows.last = Min(shadows.last, value.at_b < 0.0f ? zero : Splat(1.0f));
  }
  shadows.some = simd::Bits((highest >= 0.0f) & (shadows.first < shadows.last));
  return shadows;
}

// Whether an occluder's shadow holds a whole box.
inline bool ShadowHoldsBox(const OccluderLeaf& leaf,
                           const simd::Vec3x4& eye,
                           const simd::Vec3x4& center,
                           const simd::Vec3x4& extent) {
  using namespace simd;
  const Vec3x4 va = leaf.a - eye;
  const Float4 height = Dot(leaf.normal, va);
  const Float4 sign = height > 0.0f ? Splat(1.0f) : Splat(-1.0f);
  const auto lowest = [&](const Vec3x4& normal) {
    return sign * Dot(normal, center) - Dot(Abs(normal), extent);
  };
  Float4 least = lowest(leaf.normal) - Abs(height) - leaf.tolerance;
  if (simd::Bits(least > 0.0f) == 0) return false;
  const Vec3x4 vb = leaf.b - eye;
  const Vec3x4 vc = leaf.c - eye;
  const Vec3x4 vd = leaf.d - eye;
  least = Min(least, Min(lowest(Cross(va, vb)), lowest(Cross(vb, vc))));
  least = Min(least, Min(lowest(Cross(vc, vd)), lowest(Cross(vd, va))));
  return simd::Bits(least >= 0.0f) != 0;
}

}  // namespace ridgeline
