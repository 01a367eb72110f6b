// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

#include "camera/intrinsics.h"
#include "lines/line_segment.h"
#include "score/line_likelihood.h"
#include "score/oriented_distance_field.h"
#include "score/position_view.h"

namespace ridgeline {

// A part of a model edge and the line of the picture that runs along it.
struct EdgeMatch {
  Eigen::Vector3d a = Eigen::Vector3d::Zero();  // ends of the part, local [m]
  Eigen::Vector3d b = Eigen::Vector3d::Zero();
  // How the edge moves per metre that roofs stand out beyond their walls; zero: not a roof's border.
  Eigen::Vector3d overhang = Eigen::Vector3d::Zero();
  // The picture's line: normal . x = offset [px], the normal unit.
  Eigen::Vector2d normal = Eigen::Vector2d::Zero();
  double offset_px = 0.0;
  // Standard deviations of the line about the projected ends [px].
  double sigma_a_px = 1.0;
  double sigma_b_px = 1.0;
  // Odds that a line in the very place of the edge is the edge's own, not one at random.
  double odds = 1.0;
  // Share of an independent observation, in (0, 1]: short lines count less, and lines along one
  // edge share the model's error there.
  double weight = 1.0;
  // The same for what is known in the end, <= weight: all corners of a building share the error of
  // its place, its other edges that of its heights. Not the best weight to find a pose with, since a
  // building of many agreeing edges is seldom a wrong match.
  double information = 1.0;
  double common = 0.0;      // share of the variance that is the model's
  std::uint64_t group = 0;  // of edges that share the model's error
  std::uint32_t edge = 0;  // Scene::edge
  std::uint32_t line = 0;  // index into the picture's segments
};

struct EdgeMatchOptions {
  // Largest angle between a line and an edge [deg], at tolerance 1.
  double max_angle_deg = 4.0;
  // Lines farther from an edge than this many standard deviations are not its own.
  double max_sigmas = 3.0;
  // Least length over which a line runs along an edge [share of the picture's width]. Shorter ones
  // than `full_overlap_width` count in proportion.
  double min_overlap_width = 0.008;
  double full_overlap_width = 0.06;
  // Factor on the odds of a line that is darker on the side of the sky.
  double dark_sky_factor = 0.3;

  void Visit(OptionVisitor& v) {
    v.Field("max_angle_deg", max_angle_deg, LeftOpen(0.0, 90.0));
    v.Field("max_sigmas", max_sigmas, Positive());
    v.Field("min_overlap_width", min_overlap_width, Positive());
    v.Field("full_overlap_width",
            full_overlap_width,
            AtLeast(min_overlap_width, "min_overlap_width"));
    v.Field("dark_sky_factor", dark_sky_factor, LeftOpen(0.0, 1.0));
  }
};

// Finds for the edges seen from a pose the picture's lines beside them: nearest first, one line for
// each stretch of an edge and one edge for each stretch of a line. Thread-safe.
class EdgeMatcher {
 public:
  // All must outlive the matcher. `field` is that of `segments`; `likelihood` has the deviations and
  // the shares of edges that are seen.
  EdgeMatcher(std::span<const LineSegment> segments,
              const OrientedDistanceField& field,
              const Scene& scene,
              const LineLikelihoodOptions& likelihood,
              const EdgeMatchOptions& options);

  // @param tolerance  Factor on all deviations and angles: > 1 for a pose that is not good yet.
  // @param overhang_m  Of roofs beyond their walls.
  std::vector<EdgeMatch> Match(const PositionView& view,
                               const PinholeCamera& camera,
                               const Pose& cam_from_local,
                               double tolerance,
                               double overhang_m) const;

 private:
  struct Line {
    float angle_deg = 0.0f;  // undirected, [0, 180)
    std::uint32_t index = 0;
  };

  std::span<const LineSegment> segments_;
  const OrientedDistanceField& field_;
  const Scene& scene_;
  const LineLikelihoodOptions& likelihood_;
  EdgeMatchOptions options_;
  std::vector<Line> lines_;  // by angle
};

// How an edge moves per metre of overhang: outward from its wall and down along its roof; zero
// without a wall and a roof beside it.
Eigen::Vector3d OverhangOf(const FeatureEdge& edge, const CityModel& model);

}  // namespace ridgeline
