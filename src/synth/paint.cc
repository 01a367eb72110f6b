// SPDX-License-Identifier: Apache-2.0
#include "synth/paint.h"

#include <algorithm>
#include <cmath>

#include "base/random.h"

namespace ridgeline {
namespace {

using Eigen::Vector2d;
using Eigen::Vector2f;
using Eigen::Vector3f;

float LatticeValue(int x, int y, std::uint64_t key) {
  const auto cell = (static_cast<std::uint64_t>(static_cast<std::uint32_t>(x)) << 32) |
                    static_cast<std::uint32_t>(y);
  return static_cast<float>(MixBits(cell ^ (key * 0x9E3779B97F4A7C15ull)) >> 40) * 0x1p-24f;
}

// Distance inside a counter-clockwise convex quadrilateral [m]; negative outside.
double InsideDistance(const std::array<Vector2d, 4>& quad, const Vector2d& p) {
  double inside = 1e300;
  for (int i = 0; i < 4; ++i) {
    const Vector2d along = (quad[(i + 1) % 4] - quad[i]).normalized();
    const Vector2d offset = p - quad[i];
    inside = std::min(inside, along.x() * offset.y() - along.y() * offset.x());
  }
  return inside;
}

// Dashed line in the middle of the streets: on the axes between crossings, 2 m on, 4 m off.
bool OnLaneMarking(const Town& town, const Vector2d& p) {
  const int column = static_cast<int>(std::floor(p.x() / town.options.block_m + 0.5));
  const int row = static_cast<int>(std::floor(p.y() / town.options.block_m + 0.5));
  for (const auto& [dc, dr] : {std::pair{1, 0}, {-1, 0}, {0, 1}, {0, -1}}) {
    const Vector2d a = town.Crossing(column, row);
    const Vector2d b = town.Crossing(column + dc, row + dr);
    const Vector2d along = (b - a).normalized();
    const Vector2d offset = p - a;
    const double at = along.dot(offset);
    const double across = std::abs(along.x() * offset.y() - along.y() * offset.x());
    if (across < 0.07 && at > 9.0 && std::fmod(at, 6.0) < 2.0) return true;
  }
  return false;
}

Paint Yard(const Vector2f& at) {
  const float patches = FractalNoise(at * 0.12f, 3, 5);
  const float grain = FractalNoise(at * 3.0f, 2, 6);
  const Vector3f grass = Vector3f(0.13f, 0.21f, 0.06f) * (0.6f + 0.8f * grain);
  const Vector3f gravel = Vector3f(0.38f, 0.35f, 0.30f) * (0.8f + 0.4f * grain);
  return {patches > 0.5f ? grass : gravel, 0.0f};
}

}  // namespace

float ValueNoise(const Vector2f& at, std::uint64_t key) {
  const Vector2f cell = at.array().floor();
  const Vector2f t = at - cell;
  const Vector2f s = t.array() * t.array() * (3.0f - 2.0f * t.array());
  const int x = static_cast<int>(cell.x());
  const int y = static_cast<int>(cell.y());
  const float low = std::lerp(LatticeValue(x, y, key), LatticeValue(x + 1, y, key), s.x());
  const float high = std::lerp(LatticeValue(x, y + 1, key), LatticeValue(x + 1, y + 1, key), s.x());
  return std::lerp(low, high, s.y());
}

float FractalNoise(const Vector2f& at, int octaves, std::uint64_t key) {
  float sum = 0.0f;
  float weight = 0.5f;
  float scale = 1.0f;
  for (int i = 0; i < octaves; ++i) {
    sum += weight * ValueNoise(at * scale, key + static_cast<std::uint64_t>(i));
    scale *= 2.03f;
    weight *= 0.5f;
  }
  return sum / (1.0f - 2.0f * weight);
}

Paint PaintRoof(const Vector3f& color, const Vector3f& point) {
  // Courses of tiles follow the height; single tiles differ a little.
  const float course = std::fmod(point.z() + 1000.0f, 0.24f) / 0.24f;
  const float tile = FractalNoise(2.2f * point.head<2>(), 2, 7);
  const float shade = (course < 0.2f ? 0.78f : 1.0f) * (0.85f + 0.3f * tile);
  return {color * shade, 0.0f};
}

Paint PaintGround(const Town& town, const Vector3f& point) {
  const Vector2d p = point.head<2>().cast<double>();
  const Vector2f at = point.head<2>();
  double inside = -1e300;
  for (const TownBlock& block : town.blocks) {
    inside = std::max(inside, InsideDistance(block.curb, p));
  }
  const float grain = FractalNoise(at * 4.0f, 3, 8);
  const float patches = FractalNoise(at * 0.35f, 3, 9);
  if (inside < -30.0) {  // fields around the town
    const float field = ValueNoise(at * 0.012f, 10);
    return {Vector3f(0.16f + 0.2f * field, 0.24f, 0.07f) * (0.7f + 0.5f * grain), 0.0f};
  }
  if (inside < 0.0) {
    if (OnLaneMarking(town, p)) return {Vector3f::Constant(0.62f), 0.0f};
    return {Vector3f::Constant(0.11f + 0.05f * patches + 0.05f * grain), 0.0f};
  }
  if (inside < 0.15) return {Vector3f::Constant(0.42f), 0.0f};
  if (inside < kPavementM) {
    const bool joint =
        std::fmod(std::abs(p.x()), 0.5) < 0.03 || std::fmod(std::abs(p.y()), 0.5) < 0.03;
    return {Vector3f::Constant(joint ? 0.2f : 0.27f + 0.08f * grain), 0.0f};
  }
  return Yard(at);
}

}  // namespace ridgeline
