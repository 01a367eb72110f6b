// SPDX-License-Identifier: Apache-2.0
#include "score/position_view.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/angle.h"

namespace ridgeline {
namespace {

// The largest edges tell the most [pieces in the sector].
constexpr std::size_t kMaxPieces = 600;

void KeepLargest(VisibleSet& visible) {
  std::vector<VisiblePiece>& pieces = visible.pieces;
  if (pieces.size() <= kMaxPieces) return;
  const Eigen::Vector3f eye = visible.position.cast<float>();
  std::vector<std::pair<float, std::uint32_t>> sizes;
  for (std::uint32_t i = 0; i < pieces.size(); ++i) {
    const Eigen::Vector3f a = (pieces[i].a - eye).normalized();
    const Eigen::Vector3f b = (pieces[i].b - eye).normalized();
    sizes.emplace_back(-(a - b).squaredNorm(), i);
  }
  std::nth_element(sizes.begin(), sizes.begin() + kMaxPieces, sizes.end());
  sizes.resize(kMaxPieces);
  std::sort(
      sizes.begin(), sizes.end(), [](const auto& x, const auto& y) { return x.second < y.second; });
  std::vector<VisiblePiece> kept;
  for (const auto& [size, i] : sizes) kept.push_back(pieces[i]);
  pieces = std::move(kept);
}

}  // namespace

PositionView ViewFrom(const Scene& scene,
                      const Eigen::Vector3d& position,
                      const PanoramaRange& range,
                      const ViewParts& parts) {
  PositionView view;
  if (parts.surfaces) {
    view.surfaces = SurfacesFrom(scene, position, range);
    view.groups = GroupsOf(view.surfaces, scene.model());
  }
  if (!parts.edges_and_skyline) return view;
  view.visible = scene.VisibleFrom(position, range.sector);
  KeepLargest(view.visible);
  view.kinds.reserve(view.visible.pieces.size());
  for (const VisiblePiece& piece : view.visible.pieces) {
    view.kinds.push_back(KindOf(piece, scene));
  }
  view.skyline.reserve(view.visible.skyline_elevation.size());
  for (std::size_t i = 0; i < view.visible.skyline_elevation.size(); ++i) {
    const double azimuth =
        view.visible.first_azimuth + static_cast<double>(i) * view.visible.azimuth_step;
    const double elevation = view.visible.skyline_elevation[i];
    view.skyline.emplace_back(std::sin(azimuth) * std::cos(elevation),
                              std::cos(azimuth) * std::cos(elevation),
                              std::sin(elevation));
  }
  return view;
}

PanoramaRange RangeOf(const PinholeCamera& camera,
                      const ViewAngles& center,
                      const ViewAngles& half_ranges,
                      double step) {
  // The directions furthest out are on the border, unless straight up or down is in the picture.
  constexpr int kSteps = 16;  // per side
  std::vector<Eigen::Vector3d> border;
  for (int i = 0; i < kSteps; ++i) {
    const double t = i / double{kSteps};
    for (const Eigen::Vector2d& p : {Eigen::Vector2d(t, 0.0),
                                     Eigen::Vector2d(1.0, t),
                                     Eigen::Vector2d(1.0 - t, 1.0),
                                     Eigen::Vector2d(0.0, 1.0 - t)}) {
      border.push_back(camera.RayFromImage({camera.width * p.x(), camera.height * p.y()}));
    }
  }
  const auto is_seen = [&](const Eigen::Vector3d& direction) {
    if (direction.z() <= 0.0) return false;
    const Eigen::Vector2d pixel = camera.ImageFromCamera(direction);
    return pixel.x() >= 0.0 && pixel.x() <= camera.width && pixel.y() >= 0.0 &&
           pixel.y() <= camera.height;
  };
  double half_width = 0.0;
  double lowest = std::numbers::pi / 2.0;
  double highest = -std::numbers::pi / 2.0;
  for (const double pitch : {-1.0, 0.0, 1.0}) {
    for (const double roll : {-1.0, 0.0, 1.0}) {
      const ViewAngles angles{0.0,
                              center.pitch_deg + pitch * half_ranges.pitch_deg,
                              center.roll_deg + roll * half_ranges.roll_deg};
      const Eigen::Matrix3d cam_from_world = CamFromWorld(angles).toRotationMatrix();
      for (const Eigen::Vector3d& in_camera : border) {
        const Eigen::Vector3d ray = cam_from_world.transpose() * in_camera;
        const double elevation = std::atan2(ray.z(), std::hypot(ray.x(), ray.y()));
        lowest = std::min(lowest, elevation);
        highest = std::max(highest, elevation);
        half_width = std::max(half_width, std::abs(std::atan2(ray.x(), ray.y())));
      }
      for (const double up : {-1.0, 1.0}) {
        if (!is_seen(up * cam_from_world.col(2))) continue;
        half_width = std::numbers::pi;
        (up > 0.0 ? highest : lowest) = up * std::numbers::pi / 2.0;
      }
    }
  }
  PanoramaRange range;
  range.sector.center = center.heading_deg * kRadPerDeg;
  range.sector.half_width =
      std::min(std::numbers::pi, half_width + half_ranges.heading_deg * kRadPerDeg + 2.0 * step);
  range.sector.lowest_elevation = std::max(lowest - step, -std::numbers::pi / 2.0);
  range.sector.highest_elevation = std::min(highest + step, std::numbers::pi / 2.0);
  range.step = step;
  return range;
}

}  // namespace ridgeline
