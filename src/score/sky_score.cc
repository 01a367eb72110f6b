// SPDX-License-Identifier: Apache-2.0
#include "score/sky_score.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "projection/simd4.h"

namespace ridgeline {
namespace {

using simd::Float4;

constexpr std::size_t kChunk = 32;
constexpr float kMinZ = 0.05f;  // directions are unit vectors: nearly 90 degrees off the axis

struct SkylinePoint {
  bool is_ahead = false;
  float x = 0.0f;  // [px]; without meaning unless ahead
  float y = 0.0f;
};

void ProjectChunk(std::span<const Eigen::Vector3f> directions,
                  const PinholeCamera& camera,
                  const Eigen::Matrix3f& cam_from_world,
                  std::array<SkylinePoint, kChunk>& points) {
  const simd::Vec3x4 rows[3] = {simd::Splat(cam_from_world.row(0)),
                                simd::Splat(cam_from_world.row(1)),
                                simd::Splat(cam_from_world.row(2))};
  const auto fx = static_cast<float>(camera.fx);
  const auto fy = static_cast<float>(camera.fy);
  const auto cx = static_cast<float>(camera.cx);
  const auto cy = static_cast<float>(camera.cy);
  for (std::size_t i = 0; i < directions.size(); i += 4) {
    simd::Vec3x4 four = simd::Splat(Eigen::Vector3f::Zero());
    for (std::size_t k = 0; k < 4; ++k) {
      simd::SetLane(four, static_cast<int>(k), directions[std::min(i + k, directions.size() - 1)]);
    }
    const Float4 z = simd::Dot(rows[2], four);
    const unsigned ahead = simd::Bits(z >= kMinZ);
    const Float4 inverse_z = 1.0f / z;
    const Float4 x = fx * simd::Dot(rows[0], four) * inverse_z + cx;
    const Float4 y = fy * simd::Dot(rows[1], four) * inverse_z + cy;
    for (std::size_t k = 0; k < 4; ++k) {
      points[i + k] = {(ahead >> k & 1u) != 0, x[k], y[k]};
    }
  }
}

// Sets the rows of the columns whose centres lie in (a.x, b.x].
void DrawRows(const SkylinePoint& a, const SkylinePoint& b, std::span<float> rows) {
  if (!a.is_ahead || !b.is_ahead || !(b.x > a.x) || !(b.x > 0.0f)) return;
  if (!(a.x < static_cast<float>(rows.size()))) return;
  const int first = std::max(0, static_cast<int>(std::ceil(a.x - 0.5f)));
  const int last =
      std::min(static_cast<int>(rows.size()) - 1, static_cast<int>(std::floor(b.x - 0.5f)));
  for (int c = first; c <= last; ++c) {
    const float t = (static_cast<float>(c) + 0.5f - a.x) / (b.x - a.x);
    rows[c] = a.y + t * (b.y - a.y);
  }
}

void DrawSkyline(std::span<const Eigen::Vector3f> directions,
                 const PinholeCamera& camera,
                 const Eigen::Matrix3f& cam_from_world,
                 std::span<float> rows) {
  const auto width = static_cast<float>(rows.size());
  SkylinePoint last;
  std::array<SkylinePoint, kChunk> points;
  for (std::size_t first = 0; first < directions.size(); first += kChunk) {
    const std::size_t count = std::min(kChunk, directions.size() - first);
    ProjectChunk(directions.subspan(first, count), camera, cam_from_world, points);
    // Most of a wide skyline is beside the picture.
    float left = last.is_ahead ? last.x : width;
    float right = last.is_ahead ? last.x : 0.0f;
    for (std::size_t i = 0; i < count; ++i) {
      if (!points[i].is_ahead) continue;
      left = std::min(left, points[i].x);
      right = std::max(right, points[i].x);
    }
    if (left < width && right > 0.0f) {
      for (std::size_t i = 0; i < count; ++i) {
        DrawRows(i == 0 ? last : points[i - 1], points[i], rows);
      }
    }
    last = points[count - 1];
  }
}

// Half the range of azimuths around that of the optical axis outside of which no direction is in
// the picture: that of the cone around its corners; pi: there is no such range.
double HalfRangeInView(const PinholeCamera& camera, const Eigen::Matrix3f& cam_from_world) {
  double least_cosine = 1.0;
  for (const double x : {0.0, static_cast<double>(camera.width)}) {
    for (const double y : {0.0, static_cast<double>(camera.height)}) {
      least_cosine = std::min(least_cosine, camera.RayFromImage({x, y}).normalized().z());
    }
  }
  const double sine = std::sqrt(1.0 - least_cosine * least_cosine);
  const double level = std::hypot(cam_from_world(2, 0), cam_from_world(2, 1));
  return sine < level ? std::asin(sine / level) : std::numbers::pi;
}

}  // namespace

void SkylineRows(std::span<const Eigen::Vector3f> directions,
                 const PinholeCamera& camera,
                 const Eigen::Matrix3f& cam_from_world,
                 std::span<float> rows) {
  std::fill(rows.begin(), rows.end(), std::numeric_limits<float>::quiet_NaN());
  DrawSkyline(directions, camera, cam_from_world, rows);
}

void SkylineRows(std::span<const Eigen::Vector3f> directions,
                 double first_azimuth,
                 double step,
                 const PinholeCamera& camera,
                 const Eigen::Matrix3f& cam_from_world,
                 std::span<float> rows) {
  std::fill(rows.begin(), rows.end(), std::numeric_limits<float>::quiet_NaN());
  if (directions.empty()) return;
  const double half_range = HalfRangeInView(camera, cam_from_world) + step;
  if (half_range >= std::numbers::pi) return DrawSkyline(directions, camera, cam_from_world, rows);
  const double axis = std::atan2(cam_from_world(2, 0), cam_from_world(2, 1));
  constexpr double kTurn = 2.0 * std::numbers::pi;
  // The range once, and again where it comes round after a turn.
  double from = std::remainder(axis - half_range - first_azimuth, kTurn);
  if (from + 2.0 * half_range >= kTurn) from -= kTurn;
  const auto count = static_cast<double>(directions.size());
  std::size_t done = 0;
  for (const double start : {from, from + kTurn}) {
    const double first = std::clamp(std::floor(start / step), static_cast<double>(done), count);
    const double end = std::clamp(std::ceil((start + 2.0 * half_range) / step) + 1.0, first, count);
    DrawSkyline(directions.subspan(static_cast<std::size_t>(first),
                                   static_cast<std::size_t>(end - first)),
                camera,
                cam_from_world,
                rows);
    done = static_cast<std::size_t>(end);
  }
}

double SkyLogRatio(const SkyTable& table, std::span<const float> rows) {
  double sum = 0.0;
  for (int c = 0; c < table.columns(); ++c) {
    if (!std::isnan(rows[c])) sum += table.LogRatio(c, rows[c]);
  }
  return sum / table.columns();
}

}  // namespace ridgeline
