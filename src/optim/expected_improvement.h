// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace ridgeline {

// Natural logarithm of the expected improvement E[max(best - Y, 0)] of Y ~ N(mean, deviation^2),
// deviation > 0, and its derivatives. Accurate however unlikely the improvement is, where the plain
// formula underflows and its gradient vanishes (Ament et al. 2023, "Unexpected improvements").
struct LogImprovement {
  double value = 0.0;
  double d_mean = 0.0;
  double d_deviation = 0.0;
};
LogImprovement LogExpectedImprovement(double best, double mean, double deviation);

}  // namespace ridgeline
