// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <functional>

namespace ridgeline {

struct BoxBfgsOptions {
  int max_iterations = 50;
  // Ends when the projected gradient, or the relative gain of a step, is below this.
  double tolerance = 1e-6;
};

struct BoxBfgsResult {
  Eigen::VectorXd x;
  double value = 0.0;
};

// Value of a smooth function at x, and its gradient if `gradient` is not null. May return +infinity
// where it is not defined.
using SmoothFunction = std::function<double(const Eigen::VectorXd& x, Eigen::VectorXd* gradient)>;

// Local minimum of a smooth function of few variables in a box, from `start` (clamped to the box):
// BFGS on the variables that are free to move, with backtracking along the projected path
// (Nocedal and Wright 2006, 6.1 and 16.7).
BoxBfgsResult MinimizeInBox(const SmoothFunction& function,
                            const Eigen::VectorXd& start,
                            const Eigen::VectorXd& lower,
                            const Eigen::VectorXd& upper,
                            const BoxBfgsOptions& options);

}  // namespace ridgeline
