// SPDX-License-Identifier: Apache-2.0
#include "projection/scene.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "projection/beside.h"
#include "projection/edge_set.h"
#include "projection/horizon.h"
#include "projection/occluder_bvh.h"
#include "projection/occluders.h"
#include "projection/ray_scene.h"
#include "projection/terrain_mesh.h"
#include "projection/triangle_edges.h"

namespace ridgeline {
namespace {

constexpr double kMilli = 1e-3;

float AngleBetween(const Eigen::Vector3f& a, const Eigen::Vector3f& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

// Memory of the queries of one thread.
struct Workspace {
  std::vector<Interval> hidden;
  OccluderBvh::Hints building_hints{};
  OccluderBvh::Hints ground_hints{};
};

Workspace& ThreadWorkspace() {
  thread_local Workspace workspace;
  return workspace;
}

}  // namespace

struct Scene::Impl {
  Impl(const CityModel& city,
       const TerrainMesh& terrain,
       const TriangleEdges& mesh,
       const ProjectionOptions& projection)
      : model(city),
        options(projection),
        buildings(ModelOccluders(city, mesh, projection.surface_tolerance_m)),
        ground(TerrainOccluders(terrain, projection.terrain_tolerance_m)),
        rays(city, terrain),
        edges(city, mesh),
        horizon(city, mesh, terrain, projection.skyline_step_mrad * kMilli),
        beside(city, rays) {}

  const FeatureEdge& Feature(std::uint32_t index) const {
    const std::size_t features = model.feature_edges.size();
    return index < features ? model.feature_edges[index] : edges.weak_folds()[index - features];
  }

  const CityModel& model;
  const ProjectionOptions options;
  const OccluderBvh buildings;
  const OccluderBvh ground;
  const RayScene rays;
  const EdgeSet edges;
  const Horizon horizon;
  const BesideFinder beside;
};

Scene::Scene(const CityModel& model, const HeightGrid* dtm, const ProjectionOptions& options) {
  CheckOptions(options, "projection");
  const TerrainMesh terrain =
      dtm == nullptr ? TerrainMesh{} : MeshTerrain(*dtm, options.terrain_error_m);
  impl_ = std::make_unique<Impl>(model, terrain, FindTriangleEdges(model), options);
}

Scene::~Scene() = default;
Scene::Scene(Scene&&) noexcept = default;

VisibleSet Scene::VisibleFrom(const Eigen::Vector3d& position, const Sector& sector) const {
  const Impl& impl = *impl_;
  const SectorTest sector_test(
      sector.center, sector.half_width, sector.lowest_elevation, sector.highest_elevation);
  const Eigen::Vector3f eye = position.cast<float>();
  const auto min_angle = static_cast<float>(impl.options.min_piece_mrad * kMilli);

  Workspace& workspace = ThreadWorkspace();
  VisibleSet visible = SkylineFrom(position, sector);
  const auto is_hidden = [&](const Eigen::Vector3f& center, const Eigen::Vector3f& extent) {
    return impl.buildings.HidesBox(eye, center, extent, workspace.building_hints);
  };
  const auto add_visible_parts = [&](const SceneEdge& edge,
                                     const Eigen::Vector3f& a,
                                     const Eigen::Vector3f& b,
                                     float distance) {
    // No part shorter than this can reach the least angle.
    const float min_part = min_angle * distance / edge.length;
    std::vector<Interval>& hidden = workspace.hidden;
    hidden.clear();
    if (!impl.buildings.Hide(eye, a, b, min_part, hidden, workspace.building_hints) ||
        !impl.ground.Hide(eye, a, b, min_part, hidden, workspace.ground_hints)) {
      return;
    }
    hidden.push_back({1.0f, 1.0f});
    float first = 0.0f;
    for (const Interval& part : hidden) {
      const Eigen::Vector3f start = a + first * (b - a);
      const Eigen::Vector3f end = a + part.first * (b - a);
      const bool is_gap = part.first > first;
      first = part.last;
      if (!is_gap || AngleBetween(start, end) < min_angle) continue;
      const auto [left, right] = impl.beside.Find(eye, edge, impl.Feature(edge.index), start, end);
      visible.pieces.push_back({eye + start, eye + end, edge.index, left, right});
    }
  };
  impl.edges.ForCandidates(eye,
                           sector_test,
                           static_cast<float>(impl.options.max_distance_m),
                           min_angle,
                           is_hidden,
                           add_visible_parts);
  std::stable_sort(visible.pieces.begin(),
                   visible.pieces.end(),
                   [](const VisiblePiece& p, const VisiblePiece& q) { return p.edge < q.edge; });
  return visible;
}

VisibleSet Scene::SkylineFrom(const Eigen::Vector3d& position, const Sector& sector) const {
  const Horizon& horizon = impl_->horizon;
  const Horizon::Columns columns = horizon.ColumnsOf(sector.center, sector.half_width);
  VisibleSet visible;
  visible.position = position;
  visible.azimuth_step = horizon.step();
  visible.first_azimuth = columns.first * horizon.step();
  horizon.Elevations(position.cast<float>(),
                     columns,
                     SectorTest(sector.center, sector.half_width),
                     visible.skyline_elevation);
  return visible;
}

ViewBuffers Scene::Render(const PinholeCamera& camera,
                          const Pose& cam_from_local,
                          bool with_normals) const {
  return impl_->rays.Render(camera, cam_from_local, with_normals);
}

std::optional<double> Scene::Raycast(const Eigen::Vector3d& from,
                                     const Eigen::Vector3d& direction) const {
  const std::optional<RayHit> hit =
      impl_->rays.Cast(from.cast<float>(), direction.normalized().cast<float>());
  if (!hit) return std::nullopt;
  return hit->distance;
}

std::vector<std::uint32_t> Scene::SurfacesAlong(const Eigen::Vector3d& from,
                                                std::span<const Eigen::Vector3f> directions) const {
  std::vector<std::uint32_t> surfaces(directions.size());
  impl_->rays.CastMany(from.cast<float>(), directions, surfaces);
  return surfaces;
}

const CityModel& Scene::model() const { return impl_->model; }
const ProjectionOptions& Scene::options() const { return impl_->options; }
const FeatureEdge& Scene::edge(std::uint32_t index) const { return impl_->Feature(index); }
std::size_t Scene::edge_count() const { return impl_->edges.edges().size(); }
std::size_t Scene::memory_bytes() const {
  return impl_->buildings.memory_bytes() + impl_->ground.memory_bytes() +
         impl_->rays.memory_bytes() + impl_->edges.memory_bytes() + impl_->horizon.memory_bytes();
}

}  // namespace ridgeline
