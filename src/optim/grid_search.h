// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "base/options.h"
#include "optim/batch_search.h"

namespace ridgeline {

// Dense coarse to fine.
struct GridOptions {
  // The coarse grid has at most this many points, and two per axis at least.
  int coarse_points = 1000;
  // Places refined after the coarse grid; half as many on each finer one.
  int keep = 8;
  // Ends when the spacing is below this fraction of the ranges.
  double finest = 1e-4;

  void Visit(OptionVisitor& v);
};

// Dense, coarse to fine. A regular grid over the whole cube, visited in a random order (so that a
// short budget still sees all of it); then, around the best distinct places, neighbours at a third
// of the spacing, and again, until the spacing is below options.finest; then it ends. If no point
// of the coarse grid has an energy, twice as many per axis are tried.
// Neighbours are the 3^d - 1 of the lattice in up to four dimensions; beyond, the 2d along the axes
// and the 2^d (up to d = 10) at the corners.
SearchRoutine GridSearch(StrategyContext context, GridOptions options);

}  // namespace ridgeline
