// SPDX-License-Identifier: Apache-2.0
#include "report/overlay_layers.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "base/angle.h"

namespace ridgeline {
namespace {

// The directions a camera sees, with a margin; all around when it looks steeply up or down.
Sector SectorOf(const PinholeCamera& camera, const Pose& cam_from_local) {
  const ViewAngles angles = ViewAnglesOf(cam_from_local.cam_from_world);
  const double half_diagonal =
      std::atan(std::hypot(std::max(camera.cx, camera.width - camera.cx) / camera.fx,
                           std::max(camera.cy, camera.height - camera.cy) / camera.fy));
  Sector sector;
  sector.center = angles.heading_deg * kRadPerDeg;
  const double steepest = std::abs(angles.pitch_deg) * kRadPerDeg + half_diagonal;
  if (steepest < 0.5 * std::numbers::pi) {
    sector.half_width =
        std::min(std::numbers::pi,
                 std::asin(std::min(
                     1.0, std::sin(half_diagonal) / std::cos(angles.pitch_deg * kRadPerDeg))) +
                     0.02);
  }
  return sector;
}

}  // namespace

Rgb EdgeColor(EdgeKind kind) {
  switch (kind) {
    case EdgeKind::kSkyline:
      return {0, 220, 255};
    case EdgeKind::kOcclusion:
      return {255, 170, 0};
    case EdgeKind::kFold:
      return {255, 70, 170};
    case EdgeKind::kGround:
      return {120, 255, 90};
    case EdgeKind::kSeam:
      return {190, 160, 255};
  }
  return {};
}

const char* EdgeName(EdgeKind kind) {
  switch (kind) {
    case EdgeKind::kSkyline:
      return "model edge against the sky";
    case EdgeKind::kOcclusion:
      return "model edge before house or ground";
    case EdgeKind::kFold:
      return "corner, eaves or ridge";
    case EdgeKind::kGround:
      return "foot of a wall";
    case EdgeKind::kSeam:
      return "seam of adjoining facades";
  }
  return "";
}

std::vector<OverlayLayer> ModelEdgeLayers(const Scene& scene,
                                          const PinholeCamera& camera,
                                          const Pose& cam_from_local) {
  const VisibleSet visible =
      scene.VisibleFrom(cam_from_local.center_in_world, SectorOf(camera, cam_from_local));
  std::vector<ProjectedSegment> segments;
  ProjectPieces(visible, camera, cam_from_local, segments);
  // Skyline last, on top: it is what the eye compares first.
  constexpr std::array<EdgeKind, kEdgeKinds> kOrder = {EdgeKind::kSeam,
                                                       EdgeKind::kGround,
                                                       EdgeKind::kFold,
                                                       EdgeKind::kOcclusion,
                                                       EdgeKind::kSkyline};
  std::vector<OverlayLayer> layers;
  for (const EdgeKind kind : kOrder) {
    OverlayLayer layer;
    layer.name = EdgeName(kind);
    layer.color = EdgeColor(kind);
    layer.width_px = kind == EdgeKind::kSkyline ? 1.9 : 1.4;
    for (const ProjectedSegment& segment : segments) {
      if (KindOf(visible.pieces[segment.piece], scene) != kind) continue;
      layer.lines.push_back({segment.a, segment.b});
    }
    layers.push_back(std::move(layer));
  }
  return layers;
}

OverlayLayer BuildingEdgeLayer(const Scene& scene,
                               const PinholeCamera& camera,
                               const Pose& cam_from_local,
                               const std::vector<std::uint32_t>& buildings,
                               std::string name,
                               const Rgb& color) {
  OverlayLayer layer;
  layer.name = std::move(name);
  layer.color = color;
  layer.width_px = 2.2;
  const VisibleSet visible =
      scene.VisibleFrom(cam_from_local.center_in_world, SectorOf(camera, cam_from_local));
  std::vector<ProjectedSegment> segments;
  ProjectPieces(visible, camera, cam_from_local, segments);
  for (const ProjectedSegment& segment : segments) {
    const FeatureEdge& edge = scene.edge(visible.pieces[segment.piece].edge);
    if (edge.surface0 == kNoSurface) continue;
    const std::uint32_t building = scene.model().surfaces[edge.surface0].building;
    if (std::find(buildings.begin(), buildings.end(), building) == buildings.end()) continue;
    layer.lines.push_back({segment.a, segment.b});
  }
  return layer;
}

OverlayLayer PlainEdgeLayer(const Scene& scene,
                            const PinholeCamera& camera,
                            const Pose& cam_from_local,
                            std::string name) {
  OverlayLayer plain;
  plain.name = std::move(name);
  plain.color = {225, 225, 225};
  plain.width_px = 1.1;
  plain.opacity = 0.75;
  for (OverlayLayer& layer : ModelEdgeLayers(scene, camera, cam_from_local)) {
    for (auto& line : layer.lines) plain.lines.push_back(std::move(line));
  }
  return plain;
}

OverlayLayer SkylineLayer(const Skyline& skyline) {
  OverlayLayer layer;
  layer.name = "skyline found in the picture";
  layer.color = {255, 255, 255};
  layer.width_px = 2.0;
  std::vector<Eigen::Vector2f> run;
  for (std::size_t i = 0; i <= skyline.size(); ++i) {
    if (i < skyline.size() && skyline.columns[i] == SkylineColumn::kSeen) {
      run.emplace_back(static_cast<float>(skyline.XOf(i)), skyline.y_px[i]);
      continue;
    }
    if (run.size() > 1) layer.lines.push_back(run);
    run.clear();
  }
  return layer;
}

OverlayLayer ModelSkylineLayer(const Scene& scene,
                               const PinholeCamera& camera,
                               const Pose& cam_from_local) {
  const VisibleSet visible =
      scene.SkylineFrom(cam_from_local.center_in_world, SectorOf(camera, cam_from_local));
  OverlayLayer layer;
  layer.name = "skyline of the model";
  layer.color = EdgeColor(EdgeKind::kSkyline);
  std::vector<Eigen::Vector2f> run;
  for (std::size_t i = 0; i < visible.skyline_elevation.size(); ++i) {
    const double azimuth = visible.first_azimuth + static_cast<double>(i) * visible.azimuth_step;
    const double elevation = visible.skyline_elevation[i];
    const Eigen::Vector3d direction(std::sin(azimuth) * std::cos(elevation),
                                    std::cos(azimuth) * std::cos(elevation),
                                    std::sin(elevation));
    const Eigen::Vector3d in_camera = cam_from_local.cam_from_world * direction;
    const Eigen::Vector2d px =
        in_camera.z() > 0.01 ? camera.ImageFromCamera(in_camera) : Eigen::Vector2d(-1.0, -1.0);
    if (px.x() >= 0.0 && px.x() <= camera.width && px.y() >= 0.0 && px.y() <= camera.height) {
      run.push_back(px.cast<float>());
      continue;
    }
    if (run.size() > 1) layer.lines.push_back(run);
    run.clear();
  }
  if (run.size() > 1) layer.lines.push_back(run);
  return layer;
}

}  // namespace ridgeline
