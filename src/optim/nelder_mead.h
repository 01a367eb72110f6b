// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "base/options.h"
#include "optim/batch_search.h"

namespace ridgeline {

// Downhill simplex.
struct NelderMeadOptions {
  // Edges of the successive first simplices as fractions of the ranges, in (0, 1).
  std::vector<double> steps = {0.25, 0.1, 0.04, 0.015, 0.005};
  // Parameters that vary together, in turn, for each step: names with commas, or "*" for all.
  std::vector<std::string> groups = {"*"};
  // A simplex has converged when its extent is below this fraction of its first edge.
  double convergence = 0.1;

  void Visit(OptionVisitor& v);
};

// Downhill simplex (Nelder and Mead 1965) with the strategy of Ayadi et al. 6.1.2: the variables
// change along the way (options.groups), each has its own step (a fraction of its range), and the
// steps decrease; for each, the simplex restarts from the last solution and runs to convergence.
// After the last step the whole begins again at a random point. It starts at context.start, or in
// the middle of the box.
SearchRoutine NelderMead(StrategyContext context, NelderMeadOptions options);

}  // namespace ridgeline
