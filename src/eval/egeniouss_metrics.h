// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <span>

#include "eval/metrics.h"

namespace ridgeline {

// Bins of egenioussBench (Fanta-Jende et al. 2025); both errors lie strictly below.
inline constexpr std::array<RecallThreshold, 3> kEgenioussBins = {
    {{"0.5m_2deg", 0.5, 2.0}, {"2m_5deg", 2.0, 5.0}, {"5m_10deg", 5.0, 10.0}}};

struct EgenioussSpread {
  double median = 0.0;
  double mean = 0.0;
  double rmse = 0.0;
};

// The figures of egenioussBench: over the runs that have both an answer and a truth, as its own
// evaluation script has them, with a count of those that have a truth only.
struct EgenioussMetrics {
  int poses = 0;
  int missing = 0;
  std::array<double, kEgenioussBins.size()> share{};
  EgenioussSpread translation_m;  // between the projection centres, in three dimensions
  EgenioussSpread rotation_deg;   // angle of R_truth * R_answer^T
};

// All zero without poses.
EgenioussMetrics EgenioussMetricsOf(std::span<const RunRecord> runs);

}  // namespace ridgeline
