// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "localize/pose_scorer.h"
#include "score/building_fit.h"

namespace ridgeline {

// What speaks for a pose in absolute terms, whatever else was searched: a pose that is only better
// than the others of a box in which the truth is not shows few of the edges that it should.
struct Goodness {
  std::vector<BuildingFit> buildings;  // those with edges in the picture, the most telling first
  double observed = 0.0;               // sums over the buildings [nat]
  double expected = 0.0;
  double chance = 0.0;

  // Whether the score can tell.
  bool is_known() const { return !buildings.empty(); }
  // How much the edges could tell at the most, on average: no property of the picture.
  double information() const { return expected - chance; }
  // 1 where the edges are seen as on average they should be, 0 where they might lie anywhere.
  double explained() const {
    return information() > 0.0 ? (observed - chance) / information() : 0.0;
  }
};

// Of an admissible pose.
Goodness GoodnessOf(const PoseScorer& scorer, const PoseSpace::Offset& offset);

}  // namespace ridgeline
