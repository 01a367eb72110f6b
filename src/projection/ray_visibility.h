// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <vector>

#include "city/city_model.h"
#include "city/terrain.h"
#include "projection/ray_scene.h"
#include "projection/scene.h"

namespace ridgeline {

// Visibility of edges by rays to samples of them: a cross-check of Scene::VisibleFrom(), which is
// exact; shares no code with it but the faces. The same rules: a face hides what lies deeper
// than surface_tolerance_m behind its plane, and the terrain as if it lay terrain_tolerance_m lower.
// Thread-safe.
class RayVisibility {
 public:
  // `model` must outlive it; `dtm` may be null.
  RayVisibility(const CityModel& model, const HeightGrid* dtm, const ProjectionOptions& options);

  // How a point is seen (local frame).
  struct Seen {
    bool visible = true;
    // Of all faces that the ray meets, the greatest depth of the point behind a face's plane [m]: the
    // point is hidden by a face if it is above the tolerance. 0: none in the way.
    double depth_m = 0.0;
    bool by_terrain = false;
  };
  Seen Look(const Eigen::Vector3d& from, const Eigen::Vector3d& to) const;

  // Visible parts of the model's feature edges, sampled every `step_mrad` as seen from the position
  // (at least at three points): runs of visible samples, half a step longer at both ends. `left` and
  // `right` of the pieces are not set. Without silhouettes of weak folds.
  std::vector<VisiblePiece> PiecesFrom(const Eigen::Vector3d& position,
                                       double max_distance_m,
                                       double step_mrad) const;

 private:
  const CityModel& model_;
  ProjectionOptions options_;
  RayScene buildings_;
  RayScene ground_;  // lowered
};

}  // namespace ridgeline
