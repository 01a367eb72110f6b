// SPDX-License-Identifier: Apache-2.0
#include "replay/loeper_table.h"

#include <cmath>
#include <limits>
#include <map>
#include <tuple>

namespace ridgeline {
namespace {

double MeanOf(const std::vector<double>& values) {
  if (values.empty()) return std::numeric_limits<double>::quiet_NaN();
  double sum = 0.0;
  for (const double value : values) sum += value;
  return sum / static_cast<double>(values.size());
}

double MeanDeviationOf(const std::vector<double>& values, double mean) {
  std::vector<double> deviations;
  for (const double value : values) deviations.push_back(std::abs(value - mean));
  return MeanOf(deviations);
}

LoeperRow RowOf(std::span<const LoeperRun* const> runs, int iterations) {
  LoeperRow row;
  row.method = runs.front()->method;
  row.side_m = runs.front()->side_m;
  row.heading_deg = runs.front()->heading_deg;
  row.iterations = iterations;
  row.pictures = static_cast<int>(runs.size());
  std::vector<double> translation, kappa, absolute;
  for (const LoeperRun* run : runs) {
    const LoeperSample* best = run->BestAfter(iterations);
    if (best == nullptr) continue;
    translation.push_back(best->translation_m);
    kappa.push_back(best->kappa_deg);
    absolute.push_back(std::abs(best->kappa_deg));
    for (std::size_t t = 0; t < kLoeperLimits.size(); ++t) {
      const bool in = best->translation_m <= kLoeperLimits[t].translation_m &&
                      std::abs(best->kappa_deg) <= kLoeperLimits[t].rotation_deg;
      row.recall[t] += in ? 1.0 / row.pictures : 0.0;
    }
  }
  row.mean_translation_m = MeanOf(translation);
  row.mean_kappa_deg = MeanOf(kappa);
  row.mean_absolute_kappa_deg = MeanOf(absolute);
  row.mad_translation_m = MeanDeviationOf(translation, row.mean_translation_m);
  row.mad_kappa_deg = MeanDeviationOf(kappa, row.mean_kappa_deg);
  return row;
}

}  // namespace

std::vector<LoeperRow> LoeperTable(std::span<const LoeperRun> runs,
                                   std::span<const int> iterations) {
  // Larger boxes first, as the paper names them.
  std::map<std::tuple<std::size_t, double, double>, std::vector<const LoeperRun*>> groups;
  for (const LoeperRun& run : runs) {
    groups[{run.method, -run.side_m, run.heading_deg}].push_back(&run);
  }
  std::vector<LoeperRow> rows;
  for (const auto& [key, members] : groups) {
    for (const int count : iterations) rows.push_back(RowOf(members, count));
  }
  return rows;
}

}  // namespace ridgeline
