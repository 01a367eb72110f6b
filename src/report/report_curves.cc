// SPDX-License-Identifier: Apache-2.0
#include "report/report_curves.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <string>

#include "eval/binomial.h"

namespace ridgeline {
namespace {

bool HasTruth(const ReportRun& run) { return run.outcome != ReportOutcome::kUnknown; }

bool Within(const ReportRun& run, double limit) {
  return run.outcome != ReportOutcome::kAbstained && run.translation_m && run.rotation_deg &&
         *run.translation_m <= limit && *run.rotation_deg <= limit;
}

}  // namespace

std::vector<Share95> RecallCurve(std::span<const ReportRun> runs) {
  std::vector<Share95> curve;
  std::set<std::string> queries;
  int all = 0;
  for (const ReportRun& run : runs) {
    if (!HasTruth(run)) continue;
    queries.insert(run.id);
    ++all;
  }
  if (all == 0) return curve;
  for (int step = 1; step <= 40; ++step) {
    const double limit = 0.25 * step;
    const auto right = std::count_if(runs.begin(), runs.end(), [&](const ReportRun& run) {
      return HasTruth(run) && Within(run, limit);
    });
    const double share = static_cast<double>(right) / all;
    const Interval95 interval = WilsonInterval(share, static_cast<int>(queries.size()));
    curve.push_back({limit, share, interval.lower, interval.upper, all});
  }
  return curve;
}

std::vector<Share95> Reliability(std::span<const ReportRun> runs, int bins) {
  std::vector<int> count(bins, 0);
  std::vector<int> right(bins, 0);
  std::vector<double> sum(bins, 0.0);
  for (const ReportRun& run : runs) {
    if (run.outcome != ReportOutcome::kRight && run.outcome != ReportOutcome::kWrong) continue;
    if (!std::isfinite(run.confidence)) continue;
    const int bin = std::clamp(static_cast<int>(run.confidence * bins), 0, bins - 1);
    ++count[bin];
    right[bin] += run.outcome == ReportOutcome::kRight ? 1 : 0;
    sum[bin] += run.confidence;
  }
  std::vector<Share95> shares;
  for (int bin = 0; bin < bins; ++bin) {
    if (count[bin] == 0) continue;
    const double share = static_cast<double>(right[bin]) / count[bin];
    const Interval95 interval = WilsonInterval(share, count[bin]);
    shares.push_back({sum[bin] / count[bin], share, interval.lower, interval.upper, count[bin]});
  }
  return shares;
}

}  // namespace ridgeline
