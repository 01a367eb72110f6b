// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "localize/edge_matches.h"
#include "localize/pose_adjustment.h"
#include "localize/pose_space.h"

namespace ridgeline {

struct PoseFitOptions {
  EdgeMatchOptions matches;
  // Factor on all tolerances in the first round, halved each round until it is 1. Set by the caller,
  // who knows how good the start is.
  double first_tolerance = 2.0;
  // Rounds of matching and adjustment at most; fewer if the pose stands still.
  int max_rounds = 8;
  // Half-range of a further unknown: the error of the focal length [%]; 0: it is right.
  double focal_range_percent = 0.0;
  // Largest overhang of the roofs, a further unknown [m]; 0: the picture's roofs end at the walls.
  double max_overhang_m = 0.0;
  // A refined pose is given up for its fit (SettlePose) if that is no farther away [m, deg] and
  // loses no more of the score's log ratio.
  double max_move_m = 1.0;
  double max_turn_deg = 1.0;
  double max_loss = 1.0;

  void Visit(OptionVisitor& v) {
    v.Group("matches", [this](OptionVisitor& g) { matches.Visit(g); });
    v.Field("max_rounds", max_rounds, Positive());
    v.Field("focal_range_percent", focal_range_percent, Closed(0.0, 50.0));
    v.Field("max_overhang_m", max_overhang_m, NotNegative());
    v.Field("max_move_m", max_move_m, NotNegative());
    v.Field("max_turn_deg", max_turn_deg, NotNegative());
    v.Field("max_loss", max_loss, NotNegative());
  }
};

enum class PoseFitStatus : std::uint8_t {
  kOk,
  kUndetermined,   // some free parameters are held by the prior alone
  kNoMatches,      // no line of the picture runs along an edge
  kNotAdmissible,  // the pose given stands in a building or off the terrain
};

struct PoseFit {
  PoseFitStatus status = PoseFitStatus::kNoMatches;
  std::string reason;        // in words, unless kOk
  PoseSpace::Offset offset;  // the start, where nothing could be fitted
  double focal_factor = 1.0;
  double overhang_m = 0.0;
  // Of east, north, height [m], heading, pitch, roll [deg]; the height is the absolute one. Zero for
  // fixed parameters. Meaningless unless kOk or kUndetermined.
  Eigen::Matrix<double, 6, 6> covariance = Eigen::Matrix<double, 6, 6>::Zero();
  double focal_sigma_percent = 0.0;
  double overhang_sigma_m = 0.0;
  double sigma0 = 1.0;   // of Adjustment
  int matches = 0;       // lines along edges in the last round
  int rounds = 0;
};

// What is fitted to: the lines of a picture, and where such lines are dense.
struct PictureLines {
  std::span<const LineSegment> segments;
  const OrientedDistanceField& field;  // of the segments
  PinholeCamera camera;
};

// Refines a pose by least squares on the distances between the projected visible edges and the
// picture's lines: edges and lines are matched, the pose is adjusted, and so again (iterative closest
// lines). Where the tilt is free, all lines that may be vertical hold it, edge or not: the model's
// errors do not touch them. What the user knows holds what the picture does not: each free parameter
// has a normal prior with the standard deviation of its range (half-range / sqrt 3), and stays in its
// range.
// The matches are those of the line likelihood, one standard deviation and one share of seen edges
// for both (LineLikelihoodOptions).
PoseFit FitPose(const PictureLines& lines,
                const Scene& scene,
                const PoseSpace& space,
                const LineLikelihoodOptions& likelihood,
                const PoseFitOptions& options,
                const PoseSpace::Offset& start);

}  // namespace ridgeline
