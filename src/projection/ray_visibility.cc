// SPDX-License-Identifier: Apache-2.0
#include "projection/ray_visibility.h"

#include <algorithm>
#include <cmath>

#include "projection/terrain_mesh.h"

namespace ridgeline {
namespace {

// Rays go on behind a face from here [share of their length].
constexpr float kOn = 1e-6f;
constexpr int kMaxFaces = 64;  // along one ray; more are not looked at

TerrainMesh Lowered(const HeightGrid* dtm, const ProjectionOptions& options) {
  if (dtm == nullptr) return {};
  TerrainMesh mesh = MeshTerrain(*dtm, options.terrain_error_m);
  for (Eigen::Vector3f& vertex : mesh.vertices) {
    vertex.z() -= static_cast<float>(options.terrain_tolerance_m);
  }
  return mesh;
}

double DistanceToSegment(const Eigen::Vector3d& p,
                         const Eigen::Vector3d& a,
                         const Eigen::Vector3d& b) {
  const Eigen::Vector3d along = b - a;
  const double squared = along.squaredNorm();
  const double t = squared > 0.0 ? std::clamp((p - a).dot(along) / squared, 0.0, 1.0) : 0.0;
  return (a + t * along - p).norm();
}

}  // namespace

RayVisibility::RayVisibility(const CityModel& model,
                             const HeightGrid* dtm,
                             const ProjectionOptions& options)
    : model_(model),
      options_(options),
      buildings_(model, TerrainMesh{}),
      ground_(CityModel{}, Lowered(dtm, options)) {}

RayVisibility::Seen RayVisibility::Look(const Eigen::Vector3d& from,
                                        const Eigen::Vector3d& to) const {
  Seen seen;
  const Eigen::Vector3f origin = from.cast<float>();
  const Eigen::Vector3f direction = (to - from).cast<float>();
  float nearest = 0.0f;
  for (int face = 0; face < kMaxFaces; ++face) {
    const std::optional<RayHit> hit = buildings_.Cast(origin, direction, nearest);
    if (!hit || hit->distance >= 1.0f) break;
    // From the hit to the point is what is left of the ray.
    const double depth =
        std::abs(static_cast<double>(hit->normal.dot(direction))) * (1.0 - hit->distance);
    seen.depth_m = std::max(seen.depth_m, depth);
    nearest = hit->distance + kOn;
  }
  seen.visible = seen.depth_m <= options_.surface_tolerance_m;
  if (!seen.visible) return seen;
  const std::optional<RayHit> ground = ground_.Cast(origin, direction);
  seen.by_terrain = ground && ground->distance < 1.0f;
  seen.visible = !seen.by_terrain;
  return seen;
}

std::vector<VisiblePiece> RayVisibility::PiecesFrom(const Eigen::Vector3d& position,
                                                    double max_distance_m,
                                                    double step_mrad) const {
  std::vector<VisiblePiece> pieces;
  for (std::size_t e = 0; e < model_.feature_edges.size(); ++e) {
    const FeatureEdge& edge = model_.feature_edges[e];
    const double distance = DistanceToSegment(position, edge.a, edge.b);
    const double length = (edge.b - edge.a).norm();
    if (distance > max_distance_m || length < 1e-3) continue;
    const double step_m = std::max(1e-3, 1e-3 * step_mrad * distance);
    const int samples = std::clamp(static_cast<int>(std::ceil(length / step_m)), 3, 4096);
    const auto at = [&](double i) -> Eigen::Vector3d {
      return edge.a + std::clamp(i / samples, 0.0, 1.0) * (edge.b - edge.a);
    };
    int first = -1;
    for (int i = 0; i <= samples; ++i) {
      const bool visible = i < samples && Look(position, at(i + 0.5)).visible;
      if (visible && first < 0) first = i;
      if (visible || first < 0) continue;
      VisiblePiece piece;
      piece.a = at(first).cast<float>();
      piece.b = at(i).cast<float>();
      piece.edge = static_cast<std::uint32_t>(e);
      pieces.push_back(piece);
      first = -1;
    }
  }
  return pieces;
}

}  // namespace ridgeline
