// SPDX-License-Identifier: Apache-2.0
#include "report/report_curves.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <string>

#include "base/random.h"

namespace ridgeline {
namespace {

constexpr int kResamples = 500;
constexpr std::uint64_t kSeed = 95;

bool HasTruth(const ReportRun& run) { return run.outcome != ReportOutcome::kUnknown; }

bool Within(const ReportRun& run, double limit) {
  return run.outcome != ReportOutcome::kAbstained && run.translation_m && run.rotation_deg &&
         *run.translation_m <= limit && *run.rotation_deg <= limit;
}

// Runs of each query that has a truth.
std::vector<std::vector<const ReportRun*>> ByQuery(std::span<const ReportRun> runs) {
  std::map<std::string, std::vector<const ReportRun*>> groups;
  for (const ReportRun& run : runs) {
    if (HasTruth(run)) groups[run.id].push_back(&run);
  }
  std::vector<std::vector<const ReportRun*>> queries;
  for (auto& [id, group] : groups) queries.push_back(std::move(group));
  return queries;
}

}  // namespace

std::vector<Share95> RecallCurve(std::span<const ReportRun> runs) {
  const auto queries = ByQuery(runs);
  std::vector<Share95> curve;
  if (queries.empty()) return curve;
  for (int step = 1; step <= 40; ++step) {
    const double limit = 0.25 * step;
    std::vector<int> hits;
    int all = 0;
    int right = 0;
    for (const auto& query : queries) {
      hits.push_back(static_cast<int>(std::count_if(
          query.begin(), query.end(), [&](auto* run) { return Within(*run, limit); })));
      all += static_cast<int>(query.size());
      right += hits.back();
    }
    std::vector<double> shares(kResamples);
    for (int r = 0; r < kResamples; ++r) {
      Random random(kSeed, 0, static_cast<std::uint64_t>(r));
      double drawn = 0.0;
      double drawn_hits = 0.0;
      for (std::size_t i = 0; i < queries.size(); ++i) {
        const auto k = random.Below(queries.size());
        drawn += static_cast<double>(queries[k].size());
        drawn_hits += hits[k];
      }
      shares[r] = drawn_hits / drawn;
    }
    std::sort(shares.begin(), shares.end());
    curve.push_back({limit,
                     static_cast<double>(right) / all,
                     shares[static_cast<std::size_t>(0.025 * kResamples)],
                     shares[static_cast<std::size_t>(0.975 * kResamples) - 1],
                     all});
  }
  return curve;
}

Share95 WilsonShare(double x, int hits, int count) {
  constexpr double kZ = 1.959964;
  const double n = count;
  const double p = hits / n;
  const double middle = (p + kZ * kZ / (2.0 * n)) / (1.0 + kZ * kZ / n);
  const double half =
      kZ / (1.0 + kZ * kZ / n) * std::sqrt(p * (1.0 - p) / n + kZ * kZ / (4.0 * n * n));
  return {x, p, std::max(0.0, middle - half), std::min(1.0, middle + half), count};
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
    shares.push_back(WilsonShare(sum[bin] / count[bin], right[bin], count[bin]));
  }
  return shares;
}

}  // namespace ridgeline
