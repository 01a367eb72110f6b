// SPDX-License-Identifier: Apache-2.0
#include "score/facade_directions.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>

namespace ridgeline {
namespace {

using simd::Float4;

constexpr int kBins = 36;
// The background is this share uniform, so that a picture of one direction still tells something.
constexpr float kUniformShare = 0.3f;
// Squares of deviations are tabulated up to kMaxSquare.
constexpr int kStepsPerSquare = 16;
constexpr int kMaxSquare = 24;
constexpr int kTableSize = kStepsPerSquare * kMaxSquare + 2;

int BinOf(const LineSegment& segment) {
  const Eigen::Vector2f d = segment.b - segment.a;
  const float turns = std::atan2(d.y(), d.x()) / std::numbers::pi_v<float>;
  return (static_cast<int>(std::floor(turns * kBins)) + 2 * kBins) % kBins;
}

// Density of directions by length, smoothed over five bins with triangular weights [1 / rad].
std::array<float, kBins> DirectionDensity(std::span<const LineSegment> segments) {
  std::array<float, kBins> density{};
  float total = 0.0f;
  for (const LineSegment& segment : segments) {
    const float length = segment.Length();
    total += length;
    for (int k = -2; k <= 2; ++k) {
      density[(BinOf(segment) + k + kBins) % kBins] += length * (3 - std::abs(k)) / 9.0f;
    }
  }
  for (float& value : density) {
    const float relative = total > 0.0f ? value * kBins / total : 1.0f;
    value = ((1.0f - kUniformShare) * relative + kUniformShare) / std::numbers::pi_v<float>;
  }
  return density;
}

simd::Vec3x4 Rotated(const simd::Vec3x4 (&rows)[3], const simd::Vec3x4& v) {
  return {simd::Dot(rows[0], v), simd::Dot(rows[1], v), simd::Dot(rows[2], v)};
}

}  // namespace

FacadeDirections::FacadeDirections(std::span<const LineSegment> segments,
                                   const PinholeCamera& camera,
                                   const FacadeDirectionOptions& options)
    : log_ratios_(static_cast<std::size_t>(kBins) * kTableSize) {
  const double sigma_rad = options.sigma_deg * std::numbers::pi / 180.0;
  inverse_variance_ = static_cast<float>(1.0 / (sigma_rad * sigma_rad));
  const std::array<float, kBins> density = DirectionDensity(segments);
  // Half-normal over the angle, shared by the two directions of a surface.
  const double peak = 0.5 * std::sqrt(2.0 / std::numbers::pi) / sigma_rad;
  for (std::size_t i = 0; i < log_ratios_.size(); ++i) {
    const double square = static_cast<double>(i % kTableSize) / kStepsPerSquare;
    const double hit = peak * std::exp(-0.5 * square) / density[i / kTableSize];
    log_ratios_[i] =
        static_cast<float>(std::log(1.0 - options.aligned_share + options.aligned_share * hit));
  }
  std::vector<LineSegment> longest(segments.begin(), segments.end());
  std::stable_sort(longest.begin(), longest.end(), [](const LineSegment& x, const LineSegment& y) {
    return x.Length() > y.Length();
  });
  longest.resize(std::min<std::size_t>(longest.size(), options.max_lines), LineSegment{});
  // Neighbours side by side: four lines before the sky or the ground cost little.
  std::stable_sort(longest.begin(), longest.end(), [](const LineSegment& x, const LineSegment& y) {
    return x.a.y() + x.b.y() < y.a.y() + y.b.y();
  });
  lines_.resize((longest.size() + 3) / 4, Lines{});
  for (std::size_t i = 0; i < longest.size(); ++i) {
    const LineSegment& segment = longest[i];
    Lines& lines = lines_[i / 4];
    const int lane = static_cast<int>(i % 4);
    const Eigen::Vector2d middle = (0.5f * (segment.a + segment.b)).cast<double>();
    simd::SetLane(lines.ray, lane, camera.RayFromImage(middle).cast<float>());
    const Eigen::Vector2f direction = (segment.b - segment.a).normalized();
    lines.dx[lane] = direction.x();
    lines.dy[lane] = direction.y();
    lines.weight[lane] = segment.Length() / static_cast<float>(camera.width);
    lines.table[static_cast<std::size_t>(lane)] =
        static_cast<std::size_t>(BinOf(segment)) * kTableSize;
  }
}

// Of the angle between lines and the images of world directions given in camera axes; 1 for
// directions without image.
simd::Float4 FacadeDirections::SquareOfSine(const Lines& lines, const simd::Vec3x4& direction) {
  const Float4 x = direction.x - lines.ray.x * direction.z;
  const Float4 y = direction.y - lines.ray.y * direction.z;
  const Float4 cross = x * lines.dy - y * lines.dx;
  const Float4 norm = x * x + y * y;
  return norm > 0.0f ? cross * cross / norm : simd::Splat(1.0f);
}

float FacadeDirections::LogRatioAt(std::size_t table, float square) const {
  const float place = std::min(square, static_cast<float>(kMaxSquare)) * kStepsPerSquare;
  const auto step = static_cast<std::size_t>(place);
  const float t = place - static_cast<float>(step);
  const float* values = &log_ratios_[table + step];
  return values[0] + t * (values[1] - values[0]);
}

simd::Float4 FacadeDirections::LogRatios(const Lines& lines,
                                         const simd::Vec3x4& course,
                                         const simd::Vec3x4& rise) const {
  const Float4 squares =
      inverse_variance_ * simd::Min(SquareOfSine(lines, course), SquareOfSine(lines, rise));
  Float4 ratios;
  for (int lane = 0; lane < 4; ++lane) {
    ratios[lane] = LogRatioAt(lines.table[static_cast<std::size_t>(lane)], squares[lane]);
  }
  return lines.weight * ratios;
}

float FacadeDirections::LogRatio(const SurfacePanorama& surfaces,
                                 const CityModel& model,
                                 const Eigen::Matrix3f& cam_from_world) const {
  const simd::Vec3x4 to_camera[3] = {simd::Splat(cam_from_world.row(0)),
                                     simd::Splat(cam_from_world.row(1)),
                                     simd::Splat(cam_from_world.row(2))};
  const Eigen::Matrix3f world_from_cam = cam_from_world.transpose();
  const simd::Vec3x4 to_world[3] = {simd::Splat(world_from_cam.row(0)),
                                    simd::Splat(world_from_cam.row(1)),
                                    simd::Splat(world_from_cam.row(2))};
  Float4 sum = simd::Splat(0.0f);
  for (const Lines& lines : lines_) {
    const simd::Int4 cells = surfaces.Find(Rotated(to_world, lines.ray));
    // Courses and rises need no unit length.
    simd::Vec3x4 course = simd::Splat(Eigen::Vector3f::Zero());
    simd::Vec3x4 rise = course;
    Float4 weight = simd::Splat(0.0f);
    for (int lane = 0; lane < 4; ++lane) {
      if (cells[lane] < 0) continue;
      const std::uint32_t surface = surfaces.surfaces[static_cast<std::size_t>(cells[lane])];
      if (surface == kNoSurface || surface == kTerrainSurface) continue;
      const Eigen::Vector3f& normal = model.surfaces[surface].normal;
      if (normal.head<2>().squaredNorm() < kMinHorizontalNormal * kMinHorizontalNormal) {
        continue;
      }
      const Eigen::Vector3f along(-normal.y(), normal.x(), 0.0f);
      simd::SetLane(course, lane, along);
      simd::SetLane(rise, lane, normal.cross(along));
      weight[lane] = lines.weight[lane];
    }
    if (simd::Bits(weight > 0.0f) == 0) continue;
    sum += weight > 0.0f
               ? LogRatios(lines, Rotated(to_camera, course), Rotated(to_camera, rise))
               : simd::Splat(0.0f);
  }
  return sum[0] + sum[1] + sum[2] + sum[3];
}

}  // namespace ridgeline
