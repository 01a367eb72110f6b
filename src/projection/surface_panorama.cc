// SPDX-License-Identifier: Apache-2.0
#include "projection/surface_panorama.h"

#include <algorithm>
#include <numbers>

namespace ridgeline {

const std::uint32_t* SurfacePanorama::Find(const Eigen::Vector3f& direction) const {
  constexpr double kTurn = 2.0 * std::numbers::pi;
  const float horizontal = std::hypot(direction.x(), direction.y());
  double azimuth = std::atan2(direction.x(), direction.y()) - (first_azimuth - 0.5 * step);
  if (azimuth < 0.0) azimuth += kTurn;
  if (azimuth >= kTurn) azimuth -= kTurn;
  const int column = static_cast<int>(azimuth / step);
  const double elevation = std::atan2(direction.z(), horizontal) - (first_elevation - 0.5 * step);
  const int row = static_cast<int>(std::floor(elevation / step));
  if (column >= columns || row < 0 || row >= rows) return nullptr;
  return &surfaces[static_cast<std::size_t>(row) * columns + column];
}

SurfacePanorama SurfacesFrom(const Scene& scene,
                             const Eigen::Vector3d& position,
                             const PanoramaRange& range) {
  SurfacePanorama panorama;
  const double half_width = std::min(range.sector.half_width, std::numbers::pi);
  panorama.step = range.step;
  // In (-pi, pi], so that Find needs one turn at most.
  panorama.first_azimuth = std::remainder(range.sector.center - half_width, 2.0 * std::numbers::pi);
  panorama.first_elevation = range.lowest_elevation;
  panorama.columns = static_cast<int>(std::ceil(2.0 * half_width / range.step)) + 1;
  panorama.rows = std::max(
      1,
      static_cast<int>(std::ceil((range.highest_elevation - range.lowest_elevation) / range.step)) +
          1);
  std::vector<Eigen::Vector2f> horizontal;  // per column
  horizontal.reserve(static_cast<std::size_t>(panorama.columns));
  for (int column = 0; column < panorama.columns; ++column) {
    const double azimuth = panorama.first_azimuth + column * panorama.step;
    horizontal.emplace_back(std::sin(azimuth), std::cos(azimuth));
  }
  std::vector<Eigen::Vector3f> directions;
  directions.reserve(static_cast<std::size_t>(panorama.columns) * panorama.rows);
  for (int row = 0; row < panorama.rows; ++row) {
    const double elevation = panorama.first_elevation + row * panorama.step;
    const auto cosine = static_cast<float>(std::cos(elevation));
    const auto sine = static_cast<float>(std::sin(elevation));
    for (const Eigen::Vector2f& h : horizontal) {
      directions.emplace_back(cosine * h.x(), cosine * h.y(), sine);
    }
  }
  panorama.surfaces = scene.SurfacesAlong(position, directions);
  return panorama;
}

}  // namespace ridgeline
