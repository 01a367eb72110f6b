// SPDX-License-Identifier: Apache-2.0
#include "eval/egeniouss_metrics.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace ridgeline {
namespace {

EgenioussSpread MedianAndMean(std::vector<double> values) {
  EgenioussSpread spread;
  if (values.empty()) return spread;
  std::sort(values.begin(), values.end());
  const std::size_t middle = values.size() / 2;
  spread.median =
      values.size() % 2 == 1 ? values[middle] : 0.5 * (values[middle - 1] + values[middle]);
  const double count = static_cast<double>(values.size());
  double squares = 0.0;
  for (const double value : values) {
    spread.mean += value / count;
    squares += value * value / count;
  }
  spread.rmse = std::sqrt(squares);
  return spread;
}

}  // namespace

EgenioussMetrics EgenioussMetricsOf(std::span<const RunRecord> runs) {
  EgenioussMetrics metrics;
  std::vector<double> translations;
  std::vector<double> rotations;
  std::array<int, kEgenioussBins.size()> hits{};
  for (const RunRecord& run : runs) {
    if (!run.has_truth) continue;
    if (!run.error) {
      ++metrics.missing;
      continue;
    }
    translations.push_back(run.error->translation_m);
    rotations.push_back(run.error->rotation_deg);
    for (std::size_t b = 0; b < hits.size(); ++b) {
      const RecallThreshold& bin = kEgenioussBins[b];
      const bool within = run.error->translation_m < bin.translation_m &&
                          run.error->rotation_deg < bin.rotation_deg;
      if (within) ++hits[b];
    }
  }
  metrics.poses = static_cast<int>(translations.size());
  if (metrics.poses == 0) return metrics;
  for (std::size_t b = 0; b < hits.size(); ++b) {
    metrics.share[b] = static_cast<double>(hits[b]) / metrics.poses;
  }
  metrics.translation_m = MedianAndMean(std::move(translations));
  metrics.rotation_deg = MedianAndMean(std::move(rotations));
  return metrics;
}

}  // namespace ridgeline
