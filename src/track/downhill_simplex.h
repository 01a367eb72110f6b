// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <span>
#include <vector>

namespace ridgeline {

// A round of the downhill simplex: how far its corners lie from the start in each variable. A step
// of 0 keeps the variable in this round.
using SimplexSteps = std::vector<double>;

struct SimplexOptions {
  // A round ends when its corners differ by less than this in the function, and lie within a tenth
  // of its steps.
  double tolerance = 1e-3;
  // Evaluations of a round at most.
  int max_evaluations = 200;
};

struct SimplexResult {
  std::vector<double> point;
  double value = 0.0;
  int evaluations = 0;
};

// Downhill simplex (Nelder and Mead, 1965; coefficients 1, 2, 1/2, 1/2), begun anew from the last
// solution in every round, with that round's steps: so variables change from round to round, and
// steps can shrink (Ayadi et al., 6.1.2). Deterministic. For functions of microseconds that need
// neither bounds nor a record; searches of whole poses have the samplers of optim.
SimplexResult MinimizeBySimplex(const std::function<double(std::span<const double>)>& function,
                                const std::vector<double>& start,
                                const std::vector<SimplexSteps>& rounds,
                                const SimplexOptions& options);

}  // namespace ridgeline
