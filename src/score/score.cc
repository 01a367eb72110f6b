// SPDX-License-Identifier: Apache-2.0
#include "score/score.h"

#include <cmath>

namespace ridgeline {

namespace {

constexpr double kScale = 10.0;

}  // namespace

double Score::EnergyOf(double log_ratio) {
  return std::isnan(log_ratio) ? 1.0 : 1.0 / (1.0 + std::exp(log_ratio / kScale));
}

double Score::LogRatioOf(double energy) { return kScale * std::log((1.0 - energy) / energy); }

}  // namespace ridgeline
