// SPDX-License-Identifier: Apache-2.0
#include "lines/line_families.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace ridgeline {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr int kBins = 180;      // headings of a degree, undirected
constexpr int kSmoothing = 3;   // bins to either side, triangular weights
// A line nearer than this to the horizon has no heading: its plane is nearly horizontal.
constexpr double kMinTilt = 0.05;

// Undirected horizontal direction in the plane through a line; zero if the plane is horizontal.
Eigen::Vector3d HorizontalAlong(const LineSegment& segment,
                                const PinholeCamera& camera,
                                const Eigen::Vector3d& up) {
  const Eigen::Vector3d a = camera.RayFromImage(segment.a.cast<double>());
  const Eigen::Vector3d b = camera.RayFromImage(segment.b.cast<double>());
  const Eigen::Vector3d normal = a.cross(b).normalized();
  const Eigen::Vector3d along = normal.cross(up);
  return along.norm() < kMinTilt ? Eigen::Vector3d::Zero() : Eigen::Vector3d(along.normalized());
}

}  // namespace

double AngleToDirection(const LineSegment& segment,
                        const PinholeCamera& camera,
                        const Eigen::Vector3d& direction) {
  const Eigen::Vector2d middle = (0.5f * (segment.a + segment.b)).cast<double>();
  const Eigen::Vector3d ray = camera.RayFromImage(middle);
  const Eigen::Vector2d image(camera.fx * (direction.x() - ray.x() * direction.z()),
                              camera.fy * (direction.y() - ray.y() * direction.z()));
  const Eigen::Vector2d line = (segment.b - segment.a).cast<double>();
  const double norm = image.norm() * line.norm();
  if (norm <= 0.0) return 0.0;
  return std::asin(std::clamp((image.x() * line.y() - image.y() * line.x()) / norm, -1.0, 1.0)) *
         (image.dot(line) < 0.0 ? -1.0 : 1.0);
}

LineFamilies FindLineFamilies(std::span<const LineSegment> segments,
                              const PinholeCamera& camera,
                              const Eigen::Vector3d& up,
                              const LineFamilyOptions& options) {
  LineFamilies families;
  families.directions.push_back(up);
  families.family_of_line.assign(segments.size(), LineFamilies::kNone);
  const double max_angle = options.max_angle_deg * kPi / 180.0;

  // Axes of the horizontal plane: any two.
  const Eigen::Vector3d first =
      up.cross(std::abs(up.z()) < 0.9 ? Eigen::Vector3d::UnitZ() : Eigen::Vector3d::UnitY())
          .normalized();
  const Eigen::Vector3d second = up.cross(first);
  std::array<double, kBins> votes{};
  double total = 0.0;
  for (std::size_t i = 0; i < segments.size(); ++i) {
    total += segments[i].Length();
    if (std::abs(AngleToDirection(segments[i], camera, up)) <= max_angle) {
      families.family_of_line[i] = LineFamilies::kVertical;
      continue;
    }
    const Eigen::Vector3d along = HorizontalAlong(segments[i], camera, up);
    if (along.isZero()) continue;
    const double turns = std::atan2(along.dot(second), along.dot(first)) / kPi;
    const int bin = (static_cast<int>(std::floor(turns * kBins)) + 2 * kBins) % kBins;
    for (int k = -kSmoothing; k <= kSmoothing; ++k) {
      votes[(bin + k + kBins) % kBins] +=
          segments[i].Length() * (1.0 - std::abs(k) / (kSmoothing + 1.0));
    }
  }
  std::array<int, kBins> order{};
  for (int k = 0; k < kBins; ++k) order[k] = k;
  std::stable_sort(order.begin(), order.end(), [&](int x, int y) { return votes[x] > votes[y]; });
  const double min_cosine = std::cos(options.separation_deg * kPi / 180.0);
  for (const int bin : order) {
    if (votes[bin] < options.min_share * total || votes[bin] <= 0.0) break;
    const double angle = (bin + 0.5) * kPi / kBins;
    const Eigen::Vector3d direction = std::cos(angle) * first + std::sin(angle) * second;
    const bool is_near = std::any_of(
        families.directions.begin() + 1, families.directions.end(),
        [&](const Eigen::Vector3d& other) { return std::abs(other.dot(direction)) > min_cosine; });
    if (!is_near) families.directions.push_back(direction);
  }
  for (std::size_t i = 0; i < segments.size(); ++i) {
    if (families.family_of_line[i] == LineFamilies::kVertical) continue;
    double least = max_angle;
    for (std::size_t k = 1; k < families.directions.size(); ++k) {
      const double angle = std::abs(AngleToDirection(segments[i], camera, families.directions[k]));
      if (angle > least) continue;
      least = angle;
      families.family_of_line[i] = static_cast<int>(k);
    }
  }
  return families;
}

}  // namespace ridgeline
