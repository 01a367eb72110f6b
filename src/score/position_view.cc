// SPDX-License-Identifier: Apache-2.0
#include "score/position_view.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace ridgeline {

PositionView ViewFrom(const Scene& scene,
                      const Eigen::Vector3d& position,
                      const PanoramaRange& range,
                      const ViewParts& parts) {
  PositionView view;
  if (parts.surfaces) view.surfaces = SurfacesFrom(scene, position, range);
  if (!parts.edges_and_skyline) return view;
  view.visible = scene.VisibleFrom(position, range.sector);
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
  constexpr double kRadPerDeg = std::numbers::pi / 180.0;
  constexpr int kSteps = 16;  // points per side of the picture, and orientations per range
  double half_width = 0.0;
  double lowest = std::numbers::pi / 2.0;
  double highest = -std::numbers::pi / 2.0;
  for (const double pitch : {-1.0, 0.0, 1.0}) {
    for (const double roll : {-1.0, 0.0, 1.0}) {
      const ViewAngles angles{0.0,
                              center.pitch_deg + pitch * half_ranges.pitch_deg,
                              center.roll_deg + roll * half_ranges.roll_deg};
      const Eigen::Quaterniond world_from_cam = CamFromWorld(angles).conjugate();
      for (int i = 0; i <= kSteps; ++i) {
        for (int j = 0; j <= kSteps; ++j) {
          const Eigen::Vector3d ray =
              world_from_cam * camera.RayFromImage({camera.width * i / double{kSteps},
                                                    camera.height * j / double{kSteps}});
          const double elevation = std::atan2(ray.z(), std::hypot(ray.x(), ray.y()));
          lowest = std::min(lowest, elevation);
          highest = std::max(highest, elevation);
          half_width = std::max(half_width, std::abs(std::atan2(ray.x(), ray.y())));
        }
      }
    }
  }
  PanoramaRange range;
  range.sector.center = center.heading_deg * kRadPerDeg;
  range.sector.half_width =
      std::min(std::numbers::pi, half_width + half_ranges.heading_deg * kRadPerDeg + 2.0 * step);
  range.lowest_elevation = lowest;
  range.highest_elevation = highest;
  range.step = step;
  return range;
}

}  // namespace ridgeline
