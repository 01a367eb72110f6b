// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "base/options.h"
#include "optim/batch_search.h"

namespace ridgeline {

// Sobol points and downhill simplices in turn.
struct MultiStartOptions {
  // Sobol points of the first round, >= 4; each further round has `growth` (>= 1) times as many.
  int first_points = 32;
  double growth = 1.5;
  // Simplices started per round, >= 1.
  int descents = 4;

  void Visit(OptionVisitor& v);
};

// Local descents from the best of ever more evenly spread points; after multi-level single linkage
// (Rinnooy Kan and Timmer 1987), with a downhill simplex. Each round adds Sobol points and starts
// simplices from the best points that are apart from each other and from earlier starts. The
// distance that counts as apart, which is also the simplex's first edge, shrinks with the number of
// points as their spacing does. A descent that ends at the best point so far is polished with
// smaller simplices. Never ends.
SearchRoutine MultiStart(StrategyContext context, MultiStartOptions options);

}  // namespace ridgeline
