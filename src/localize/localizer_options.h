// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "base/options.h"
#include "lines/line_detector.h"
#include "localize/confidence.h"
#include "localize/fit_pose.h"
#include "localize/pose_space.h"
#include "optim/sampler_options.h"
#include "projection/scene.h"
#include "score/score_options.h"

namespace ridgeline {

// Dense map over the search box, then refinement of its modes.
struct MapOptions {
  // Spacing of positions [m] and headings [deg].
  double spacing_m = 1.0;
  double heading_step_deg = 1.0;
  // Most positions looked at; the spacing grows until the box has no more.
  int max_positions = 600;
  // Hypotheses of pitch and roll from the picture's vertical lines, where they are free.
  int tilts = 2;
  // Modes refined, and the least distance between them.
  int modes = 12;
  double mode_separation_m = 1.5;
  double mode_separation_deg = 2.5;

  void Visit(OptionVisitor& v);
};

struct SearchOptions {
  PoseSpaceOptions space;
  // "map", or the sampler of `sampler` with `evaluations`.
  std::string method = "map";
  MapOptions map;
  int evaluations = 200;
  SamplerOptions sampler;
  // Whether the modes are refined on the exact score.
  bool refine = true;
  // How often the box is made wider: once where no pose of it explains the picture, again where the
  // answer lies on a limit; fixed parameters stay fixed.
  int widenings = 2;
  // "compass": on the score alone. "fit": the best mode is then fitted by least squares.
  std::string refinement = "compass";
  PoseFitOptions fit;

  void Visit(OptionVisitor& v);
};

// Everything that can be set about a localization; configs/default.json is a dump of it.
struct LocalizerOptions {
  LineDetectionOptions lines;
  ProjectionOptions projection;
  ScoreOptions score;
  SearchOptions search;
  ConfidenceOptions confidence;

  void Visit(OptionVisitor& v);
  void Validate() const;
};

}  // namespace ridgeline
