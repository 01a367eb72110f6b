// SPDX-License-Identifier: Apache-2.0
#include "score/facade_directions.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>

#include "base/error.h"

namespace ridgeline {
namespace {

constexpr float kPi = std::numbers::pi_v<float>;
constexpr int kBins = 36;
// The background is this share uniform, so that a picture of one direction still tells something.
constexpr float kUniformShare = 0.3f;

int BinOf(const LineSegment& segment) {
  const Eigen::Vector2f d = segment.b - segment.a;
  const float turns = std::atan2(d.y(), d.x()) / kPi;
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
    value = ((1.0f - kUniformShare) * relative + kUniformShare) / kPi;
  }
  return density;
}

}  // namespace

void FacadeDirectionOptions::Validate() const {
  if (!(aligned_share > 0.0 && aligned_share < 1.0)) {
    throw InputError("", "score.facades.aligned_share", std::to_string(aligned_share), "(0, 1)");
  }
  if (!(sigma_deg > 0.0)) {
    throw InputError("", "score.facades.sigma_deg", std::to_string(sigma_deg), "> 0");
  }
  if (max_lines < 1) {
    throw InputError("", "score.facades.max_lines", std::to_string(max_lines), ">= 1");
  }
}

FacadeDirections::FacadeDirections(std::span<const LineSegment> segments,
                                   const PinholeCamera& camera,
                                   const FacadeDirectionOptions& options)
    : aligned_share_(static_cast<float>(options.aligned_share)),
      sigma_rad_(static_cast<float>(options.sigma_deg) * kPi / 180.0f) {
  const std::array<float, kBins> density = DirectionDensity(segments);
  lines_.reserve(segments.size());
  for (const LineSegment& segment : segments) {
    const Eigen::Vector2d middle = (0.5f * (segment.a + segment.b)).cast<double>();
    lines_.push_back({camera.RayFromImage(middle).cast<float>(),
                      (segment.b - segment.a).normalized(),
                      segment.Length() / static_cast<float>(camera.width),
                      density[BinOf(segment)]});
  }
  const std::size_t kept = std::min<std::size_t>(lines_.size(), options.max_lines);
  std::stable_sort(lines_.begin(), lines_.end(),
                   [](const Line& x, const Line& y) { return x.weight > y.weight; });
  lines_.resize(kept, lines_.empty() ? Line{} : lines_.front());
}

float FacadeDirections::LogRatio(const SurfacePanorama& surfaces,
                                 const CityModel& model,
                                 const Eigen::Matrix3f& cam_from_world) const {
  constexpr float kMinHorizontal = 0.1f;  // flat roofs and floors have no course
  const Eigen::Matrix3f world_from_cam = cam_from_world.transpose();
  // Half-normal over the angle, shared by the two directions of a surface.
  const float peak = 0.5f * std::sqrt(2.0f / kPi) / sigma_rad_;
  float sum = 0.0f;
  for (const Line& line : lines_) {
    const std::uint32_t* surface = surfaces.Find(world_from_cam * line.ray);
    if (surface == nullptr || *surface == kNoSurface || *surface == kTerrainSurface) continue;
    const Eigen::Vector3f& normal = model.surfaces[*surface].normal;
    const float horizontal = std::hypot(normal.x(), normal.y());
    if (horizontal < kMinHorizontal) continue;
    const Eigen::Vector3f course(-normal.y() / horizontal, normal.x() / horizontal, 0.0f);
    const Eigen::Vector3f rise = normal.cross(course);
    float sine = 1.0f;
    for (const Eigen::Vector3f& along : {course, rise}) {
      const Eigen::Vector3f c = cam_from_world * along;
      const Eigen::Vector2f d(c.x() - line.ray.x() * c.z(), c.y() - line.ray.y() * c.z());
      const float norm = d.norm();
      if (norm <= 0.0f) continue;
      const float cross = d.x() * line.direction.y() - d.y() * line.direction.x();
      sine = std::min(sine, std::abs(cross) / norm);
    }
    const float z = sine / sigma_rad_;
    const float hit = peak * std::exp(-0.5f * z * z);
    sum += line.weight *
           std::log(1.0f - aligned_share_ + aligned_share_ * hit / line.background);
  }
  return sum;
}

}  // namespace ridgeline
