// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <cstdint>

#ifdef __SSE2__
#include <emmintrin.h>
#endif

namespace ridgeline::simd {

// Four floats side by side: GCC's and Clang's vector extension, on any processor.
using Float4 = float __attribute__((vector_size(16)));
using Int4 = std::int32_t __attribute__((vector_size(16)));

struct Vec3x4 {
  Float4 x, y, z;
};

inline Float4 Splat(float value) { return Float4{value, value, value, value}; }
inline Float4 Max(Float4 a, Float4 b) { return a > b ? a : b; }
inline Float4 Min(Float4 a, Float4 b) { return a < b ? a : b; }

inline Float4 Sqrt(Float4 v) {
#ifdef __SSE2__
  return reinterpret_cast<Float4>(_mm_sqrt_ps(reinterpret_cast<__m128>(v)));
#else
  return Float4{std::sqrt(v[0]), std::sqrt(v[1]), std::sqrt(v[2]), std::sqrt(v[3])};
#endif
}

// Bit k is set where comparison k holds.
inline unsigned Bits(Int4 comparison) {
#ifdef __SSE2__
  return static_cast<unsigned>(_mm_movemask_ps(reinterpret_cast<__m128>(comparison)));
#else
  return static_cast<unsigned>((comparison[0] & 1) | (comparison[1] & 2) | (comparison[2] & 4) |
                               (comparison[3] & 8));
#endif
}

inline Float4 Dot(const Vec3x4& a, const Vec3x4& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

inline Vec3x4 Cross(const Vec3x4& a, const Vec3x4& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

inline Vec3x4 operator-(const Vec3x4& a, const Vec3x4& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}

inline Float4 Abs(Float4 v) { return Max(v, -v); }
inline Vec3x4 Abs(const Vec3x4& v) { return {Abs(v.x), Abs(v.y), Abs(v.z)}; }

inline Vec3x4 Splat(const Eigen::Vector3f& v) { return {Splat(v.x()), Splat(v.y()), Splat(v.z())}; }

inline void SetLane(Vec3x4& target, int lane, const Eigen::Vector3f& value) {
  target.x[lane] = value.x();
  target.y[lane] = value.y();
  target.z[lane] = value.z();
}

}  // namespace ridgeline::simd
