// SPDX-License-Identifier: Apache-2.0
#include "optim/expected_improvement.h"

#include <cmath>
#include <numbers>

namespace ridgeline {
namespace {

// Where erfc is still a normal number; beyond, the series of Mills' ratio is exact enough.
constexpr double kSeriesFrom = 25.0;

double Density(double z) { return std::exp(-0.5 * z * z) / std::sqrt(2.0 * std::numbers::pi); }

double Distribution(double z) { return 0.5 * std::erfc(-z / std::numbers::sqrt2); }

}  // namespace

LogImprovement LogExpectedImprovement(double best, double mean, double deviation) {
  const double z = (best - mean) / deviation;
  // With h(z) = density + z * distribution: EI = deviation * h.
  double log_h = 0.0;
  double density_over_h = 0.0;
  double distribution_over_h = 0.0;
  if (z > -1.0) {
    const double h = Density(z) + z * Distribution(z);
    log_h = std::log(h);
    density_over_h = Density(z) / h;
    distribution_over_h = Distribution(z) / h;
  } else {
    // h = density * (1 - t m), with t = -z and Mills' ratio m = distribution(-t) / density(t).
    const double t = -z;
    const double s = 1.0 / (t * t);
    double mills = 0.0;
    double rest = 0.0;
    if (t < kSeriesFrom) {
      mills = Distribution(z) / Density(z);
      rest = 1.0 - t * mills;
    } else {
      rest = s * (1 - s * (3 - s * (15 - s * (105 - s * (945 - s * (10395 - s * 135135))))));
      mills = (1.0 - rest) / t;
    }
    log_h = -0.5 * z * z - 0.5 * std::log(2.0 * std::numbers::pi) + std::log(rest);
    density_over_h = 1.0 / rest;
    distribution_over_h = mills / rest;
  }
  return {
      std::log(deviation) + log_h, -distribution_over_h / deviation, density_over_h / deviation};
}

}  // namespace ridgeline
