// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <bit>

#include "projection/scene.h"
#include "projection/simd4.h"

namespace ridgeline {
namespace {

using simd::Float4;
using simd::Int4;
using simd::Vec3x4;

constexpr float kNearPlane = 0.1f;  // [m]
constexpr std::size_t kLanes = 4;

// The parts of four lines on one side of planes, as intervals of their parameters in [0, 1].
struct ClippedParts {
  Float4 first = simd::Splat(0.0f);
  Float4 last = simd::Splat(1.0f);
  Int4 outside = {};

  // Keeps the parameters where a value going linearly from `at_a` to `at_b` is >= 0.
  void Clip(Float4 at_a, Float4 at_b) {
    const Int4 a_outside = at_a < 0.0f;
    const Int4 b_outside = at_b < 0.0f;
    if (simd::Bits(a_outside | b_outside) == 0) return;
    outside |= a_outside & b_outside;
    const Float4 crossing = at_a / (at_a - at_b);
    first = a_outside ? simd::Max(first, crossing) : first;
    last = b_outside ? simd::Min(last, crossing) : last;
  }
  bool AreAllOutside() const { return simd::Bits(outside) == 0xFu; }
  // The lanes of which something is left.
  unsigned Left() const { return simd::Bits(~outside & (first < last)); }
};

Float4 RowTimes(const Eigen::Matrix3f& matrix, int row, const Vec3x4& v) {
  return matrix(row, 0) * v.x + (matrix(row, 1) * v.y + matrix(row, 2) * v.z);
}

Vec3x4 Times(const Eigen::Matrix3f& matrix, const Vec3x4& v) {
  return {RowTimes(matrix, 0, v), RowTimes(matrix, 1, v), RowTimes(matrix, 2, v)};
}

Vec3x4 Between(const Vec3x4& a, const Vec3x4& b, Float4 t) {
  return {a.x + t * (b.x - a.x), a.y + t * (b.y - a.y), a.z + t * (b.z - a.z)};
}

// The first end (or the second) of up to four pieces; the last piece fills the places left over.
Vec3x4 EndsOf(const VisiblePiece* pieces, std::size_t count, Eigen::Vector3f VisiblePiece::*end) {
  Vec3x4 ends;
  for (std::size_t k = 0; k < kLanes; ++k) {
    simd::SetLane(ends, static_cast<int>(k), pieces[std::min(k, count - 1)].*end);
  }
  return ends;
}

}  // namespace

void ProjectPieces(const VisibleSet& visible,
                   const PinholeCamera& camera,
                   const Pose& cam_from_local,
                   std::vector<ProjectedSegment>& segments) {
  segments.clear();
  // Homogeneous image points: (x_px * z, y_px * z, z) = image_from_local * (point - center).
  Eigen::Matrix3d calibration;
  calibration << camera.fx, 0.0, camera.cx, 0.0, camera.fy, camera.cy, 0.0, 0.0, 1.0;
  const Eigen::Matrix3f image_from_local =
      (calibration * cam_from_local.cam_from_world.toRotationMatrix()).cast<float>();
  const Vec3x4 center = simd::Splat(cam_from_local.center_in_world.cast<float>());
  const auto width = static_cast<float>(camera.width);
  const auto height = static_cast<float>(camera.height);
  for (std::size_t i = 0; i < visible.pieces.size(); i += kLanes) {
    const std::size_t count = std::min(kLanes, visible.pieces.size() - i);
    const VisiblePiece* const pieces = &visible.pieces[i];
    const Vec3x4 a = Times(image_from_local, EndsOf(pieces, count, &VisiblePiece::a) - center);
    const Vec3x4 b = Times(image_from_local, EndsOf(pieces, count, &VisiblePiece::b) - center);
    // The five planes are linear in the homogeneous point: near, left, right, top, bottom.
    ClippedParts parts;
    parts.Clip(a.z - kNearPlane, b.z - kNearPlane);
    parts.Clip(a.x, b.x);
    parts.Clip(width * a.z - a.x, width * b.z - b.x);
    if (parts.AreAllOutside()) continue;
    parts.Clip(a.y, b.y);
    parts.Clip(height * a.z - a.y, height * b.z - b.y);
    unsigned left = parts.Left() & ((1u << count) - 1u);
    if (left == 0) continue;
    const Vec3x4 start = Between(a, b, parts.first);
    const Vec3x4 end = Between(a, b, parts.last);
    const Float4 start_x = start.x / start.z;
    const Float4 start_y = start.y / start.z;
    const Float4 end_x = end.x / end.z;
    const Float4 end_y = end.y / end.z;
    const Float4 inverse_start_z = 1.0f / start.z;
    const Float4 inverse_end_z = 1.0f / end.z;
    const Float4 depth = 0.5f * (start.z + end.z);
    for (; left != 0; left &= left - 1) {
      const int k = std::countr_zero(left);
      segments.push_back({{start_x[k], start_y[k]},
                          {end_x[k], end_y[k]},
                          static_cast<std::uint32_t>(i) + static_cast<std::uint32_t>(k),
                          depth[k],
                          inverse_start_z[k],
                          inverse_end_z[k]});
    }
  }
}

}  // namespace ridgeline
