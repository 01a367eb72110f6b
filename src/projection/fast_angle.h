// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <numbers>

#include "projection/simd4.h"

namespace ridgeline {

// Arc tangent for x in [0, 1]; error below 2e-7 in floats. T: float or simd::Float4.
// Source: Abramowitz & Stegun, Handbook of Mathematical Functions, 4.4.49.
template <typename T>
inline T FastAtanUpToOne(T x) {
  const T s = x * x;
  T p = 0.0028662257f * s - 0.0161657367f;
  p = p * s + 0.0429096138f;
  p = p * s - 0.0752896400f;
  p = p * s + 0.1065626393f;
  p = p * s - 0.1420889944f;
  p = p * s + 0.1999355085f;
  p = p * s - 0.3333314528f;
  return x + x * s * p;
}

// Angles of four vectors (x, y) from the x axis, x and y >= 0: [0, pi / 2]. 0 for (0, 0).
inline simd::Float4 FastAngleFromAxis(simd::Float4 x, simd::Float4 y) {
  constexpr float kTiny = 1e-30f;
  const simd::Float4 larger = simd::Max(simd::Max(x, y), simd::Splat(kTiny));
  const simd::Float4 angle = FastAtanUpToOne(simd::Min(x, y) / larger);
  return y > x ? static_cast<float>(std::numbers::pi / 2) - angle : angle;
}

// Arc tangent for x >= 0; error below 3e-7.
inline float FastAtan(float x) {
  const bool steep = x > 1.0f;
  const float angle = FastAtanUpToOne(steep ? 1.0f / x : x);
  return steep ? static_cast<float>(std::numbers::pi / 2) - angle : angle;
}

// Azimuth of a direction, clockwise from north, in (-pi, pi]; error below 5e-7. 0 for (0, 0).
inline float FastAzimuth(float east, float north) {
  const float e = std::abs(east);
  const float n = std::abs(north);
  if (e == 0.0f && n == 0.0f) return 0.0f;
  constexpr auto kPi = static_cast<float>(std::numbers::pi);
  float angle = e > n ? kPi / 2 - FastAtanUpToOne(n / e) : FastAtanUpToOne(e / n);
  if (north < 0.0f) angle = kPi - angle;
  return east < 0.0f ? -angle : angle;
}

}  // namespace ridgeline
