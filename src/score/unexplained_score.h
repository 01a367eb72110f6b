// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "base/options.h"
#include "camera/intrinsics.h"
#include "lines/line_segment.h"
#include "score/edge_kind.h"
#include "score/oriented_distance_field.h"
#include "score/score.h"

namespace ridgeline {

struct UnexplainedScoreOptions {
  // An edge is explained by a line, and a line by an edge, this near [share of the picture's
  // width].
  double max_distance_width = 0.01;
  // Lines looked at: the strongest by length times gradient.
  int max_lines = 200;
  // Lines this near to a modelled outline [share of the picture's width] should be explained.
  double outline_width = 0.04;
  // Spacing of samples along edges and lines [share of the picture's width].
  double spacing_width = 0.008;

  void Visit(OptionVisitor& v) {
    v.Field("max_distance_width", max_distance_width, Positive());
    v.Field("max_lines", max_lines, Positive());
    v.Field("outline_width", outline_width, Positive());
    v.Field("spacing_width", spacing_width, Positive());
  }
};

// What edges and lines leave of each other. E: share of the length of the projected edges with a
// line of their direction beside them. L: share of the strong lines near modelled outlines (sky or
// another building behind the edge), by length and gradient, that have an edge of their direction
// beside them (within a direction bin of 10 degrees and a cell of 1/64 of the picture's longer
// side). The energy is 1 - 2 E L / (E + L): a pose that shows few edges leaves lines unexplained,
// one that shows many leaves edges.
class UnexplainedScore final : public Score {
 public:
  // `segments` in the pixels of `camera`, `field` theirs; both must outlive the score.
  UnexplainedScore(std::span<const LineSegment> segments,
                   const OrientedDistanceField& field,
                   const PinholeCamera& camera,
                   const UnexplainedScoreOptions& options);

  ViewParts parts() const override { return {true, false}; }
  const char* unusable() const override {
    return samples_.empty() ? "the picture has no lines" : "";
  }
  double LogRatio(const PositionView& view,
                  const Pose& cam_from_local,
                  Workspace& workspace) const override;

  struct Shares {
    double edges = 0.0;  // explained by lines
    double lines = 0.0;  // explained by edges
    double Energy() const {
      return edges > 0.0 && lines > 0.0 ? 1.0 - 2.0 * edges * lines / (edges + lines) : 1.0;
    }
  };
  // Of projected edges and their kinds (per piece).
  Shares SharesOf(std::span<const ProjectedSegment> segments,
                  std::span<const EdgeKind> kinds) const;

 private:
  // Part of a strong line.
  struct Sample {
    std::uint16_t cell = 0;
    std::uint32_t directions = 0;  // bit per bin: its own and its neighbours
    float weight = 0.0f;
  };

  const OrientedDistanceField& field_;
  PinholeCamera camera_;
  float cell_px_ = 1.0f;
  float spacing_px_ = 1.0f;
  int outline_cells_ = 1;
  float max_units_ = 1.0f;
  std::vector<Sample> samples_;
};

}  // namespace ridgeline
