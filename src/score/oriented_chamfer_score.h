// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "base/options.h"
#include "camera/intrinsics.h"
#include "score/oriented_distance_field.h"
#include "score/score.h"

namespace ridgeline {

struct OrientedChamferOptions {
  // Distance at which a sample counts the most [share of the picture's width], at most 31 px.
  double max_distance_width = 0.02;
  // What a degree between edge and line costs, as a distance [share of the picture's width].
  double per_degree_width = 0.0006;
  // Spacing of samples along an edge [share of the picture's width].
  double spacing_width = 0.008;

  void Visit(OptionVisitor& v) {
    v.Field("max_distance_width", max_distance_width, Positive());
    v.Field("per_degree_width", per_degree_width, Positive());
    v.Field("spacing_width", spacing_width, Positive());
  }
};

// Directional chamfer distance: a sample of a projected edge costs the least sum of its distance to
// a line and of the angle between them, limited to the largest distance. The energy is the mean
// over all samples, in units of the largest distance: 0 if all edges lie on lines of their
// direction. Liu et al., "Fast directional chamfer matching", CVPR 2010, with lines' own
// directions.
class OrientedChamferScore final : public Score {
 public:
  // Keeps nothing of `field`; `camera` is that of the field's picture.
  OrientedChamferScore(const OrientedDistanceField& field,
                       const PinholeCamera& camera,
                       const OrientedChamferOptions& options);

  ViewParts parts() const override { return {true, false}; }
  const char* unusable() const override { return has_lines_ ? "" : "the picture has no lines"; }
  double LogRatio(const PositionView& view,
                  const Pose& cam_from_local,
                  Workspace& workspace) const override;
  // Of projected edges; 1 without any, and for a picture without lines.
  double EnergyOfEdges(std::span<const ProjectedSegment> segments) const;

 private:
  PinholeCamera camera_;
  float spacing_px_ = 1.0f;
  float limit_units_ = 1.0f;
  bool has_lines_ = false;
  std::vector<std::uint8_t> costs_;  // by direction, row, column [1/8 px]
};

}  // namespace ridgeline
