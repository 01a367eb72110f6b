// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "base/options.h"
#include "camera/intrinsics.h"
#include "camera/pose.h"
#include "city/city_model.h"
#include "city/terrain.h"
#include "projection/view_buffers.h"
#include "projection/visible_set.h"

namespace ridgeline {

struct ProjectionOptions {
  // Edges farther than this are ignored [m].
  double max_distance_m = 400.0;
  // Shortest visible piece kept, as seen from the position [mrad]; about a pixel.
  double min_piece_mrad = 2.0;
  // Largest spacing of the virtual skyline's azimuths [mrad].
  double skyline_step_mrad = 2.0;
  // An edge is hidden by a model face only where it lies deeper than this behind the face's plane
  // [m]: it does not hide behind its own faces, nor behind walls that should be coplanar.
  double surface_tolerance_m = 0.03;
  // The terrain hides edges as if it lay this much lower [m]: ground lines are that uncertain.
  double terrain_tolerance_m = 0.3;
  // Largest height error of the triangles that stand for the terrain model [m].
  double terrain_error_m = 0.1;

  void Visit(OptionVisitor& v) {
    v.Field("max_distance_m", max_distance_m, Positive());
    v.Field("min_piece_mrad", min_piece_mrad, NotNegative());
    v.Field("skyline_step_mrad", skyline_step_mrad, Closed(0.01, 1000.0));
    v.Field("surface_tolerance_m", surface_tolerance_m, NotNegative());
    v.Field("terrain_tolerance_m", terrain_tolerance_m, NotNegative());
    v.Field("terrain_error_m", terrain_error_m, NotNegative());
  }
};

// The model and the terrain around it. Thread-safe after construction.
class Scene {
 public:
  // The model must outlive the scene; `dtm` may be null (then nothing hides behind hills).
  Scene(const CityModel& model, const HeightGrid* dtm, const ProjectionOptions& options);
  ~Scene();
  Scene(Scene&&) noexcept;

  // Visible pieces of feature edges and silhouettes from `position` (local) within the sector,
  // exact: the shadows of all faces are cut out of each edge. Edges below a millimetre are not
  // looked at, and edges of a closed shell are seen from outside only: inside a closed building or
  // below the terrain there are no pieces. A ray that hits nothing sees the ground below the
  // horizontal (VisiblePiece::left, right), else the sky.
  VisibleSet VisibleFrom(const Eigen::Vector3d& position, const Sector& sector) const;
  // The skyline alone (no pieces), at a fraction of the cost.
  VisibleSet SkylineFrom(const Eigen::Vector3d& position, const Sector& sector) const;

  // One ray per pixel centre. Pixels that hit neither model nor terrain are sky.
  ViewBuffers Render(const PinholeCamera& camera,
                     const Pose& cam_from_local,
                     bool with_normals = false) const;

  // Distance [m] to the first hit of a ray, nullopt: sky.
  std::optional<double> Raycast(const Eigen::Vector3d& from,
                                const Eigen::Vector3d& direction) const;

  // The surfaces hit first by rays from one point: kTerrainSurface for the terrain, kNoSurface for
  // the sky. In packets: fast if directions next to each other in the list are so in space.
  std::vector<std::uint32_t> SurfacesAlong(const Eigen::Vector3d& from,
                                           std::span<const Eigen::Vector3f> directions) const;

  const CityModel& model() const;
  const ProjectionOptions& options() const;
  // The edge of VisiblePiece::edge.
  const FeatureEdge& edge(std::uint32_t index) const;
  std::size_t edge_count() const;
  // Of everything the scene keeps, without the model.
  std::size_t memory_bytes() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

// A segment in the image [px], from a to b as in its piece.
struct ProjectedSegment {
  Eigen::Vector2f a = Eigen::Vector2f::Zero();
  Eigen::Vector2f b = Eigen::Vector2f::Zero();
  std::uint32_t piece = 0;       // index into VisibleSet::pieces
  float depth = 0.0f;            // of the middle, along the optical axis [m]
  float inverse_depth_a = 0.0f;  // of the ends [1 / m]; linear along the segment in the image
  float inverse_depth_b = 0.0f;
};

// Projects the pieces into the image, clipped to the near plane (0.1 m) and to the image. Appends
// to `segments` after clearing it, so that the caller's memory is used again.
void ProjectPieces(const VisibleSet& visible,
                   const PinholeCamera& camera,
                   const Pose& cam_from_local,
                   std::vector<ProjectedSegment>& segments);

}  // namespace ridgeline
