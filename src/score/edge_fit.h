// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "camera/intrinsics.h"
#include "camera/pose.h"
#include "projection/scene.h"
#include "score/building_fit.h"
#include "score/edge_kind.h"
#include "score/line_likelihood.h"
#include "score/oriented_distance_field.h"

namespace ridgeline {

// Judges single buildings by the lines of a picture: the goodness of fit of a pose, and which part
// of the model disagrees with it. Expectations follow from the distributions of LineLikelihood: the
// mean of its log ratio under its two hypotheses (Kullback and Leibler, "On information and
// sufficiency", 1951).
class EdgeFit {
 public:
  // `field` must outlive it.
  EdgeFit(const OrientedDistanceField& field,
          const PinholeCamera& camera,
          const LineLikelihoodOptions& options);

  // Of all buildings with edges in the picture, by index. `segments` are the projected pieces of
  // `visible` at the pose, `kinds` those of its pieces; weights by kind of edge.
  std::vector<BuildingFit> Of(std::span<const ProjectedSegment> segments,
                              const VisibleSet& visible,
                              std::span<const EdgeKind> kinds,
                              std::span<const double> weights,
                              const Scene& scene,
                              const Pose& cam_from_local) const;

 private:
  struct Cell {  // of the tables by kind, sigma and density
    float expected = 0.0f;
    float chance = 0.0f;
  };
  static constexpr int kDistances = 256;
  static constexpr int kDensityLevels = OrientedDistanceField::kHiddenLevel + 1;

  std::size_t CellIndex(EdgeKind kind, int sigma_level, int density_level) const {
    return (static_cast<std::size_t>(kind) * LineLikelihood::kSigmaLevels + sigma_level) * kDensityLevels +
           density_level;
  }
  int SigmaLevel(float inverse_depth) const;

  const OrientedDistanceField& field_;
  PinholeCamera camera_;
  double spacing_px_ = 1.0;
  double sigma_px_ = 1.0;
  double sigma_model_px_m_ = 0.0;
  std::vector<float> ratios_;  // by cell, then distance
  std::vector<Cell> cells_;
};

}  // namespace ridgeline
