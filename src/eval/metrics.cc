// SPDX-License-Identifier: Apache-2.0
#include "eval/metrics.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>
namespace ridgeline {
namespace {

bool Within(const RunRecord& run, const RecallThreshold& threshold) {
  return run.error && run.error->translation_m <= threshold.translation_m &&
         run.error->rotation_deg <= threshold.rotation_deg;
}

double Quantile(std::vector<double> values, double q) {
  if (values.empty()) return 0.0;
  std::sort(values.begin(), values.end());
  const double position = q * static_cast<double>(values.size() - 1);
  const std::size_t lower = static_cast<std::size_t>(position);
  const std::size_t upper = std::min(lower + 1, values.size() - 1);
  return std::lerp(values[lower], values[upper], position - static_cast<double>(lower));
}

Spread SpreadOf(const std::vector<double>& values) {
  if (values.empty()) return {};
  const double n = static_cast<double>(values.size());
  Spread spread;
  spread.median = Quantile(values, 0.5);
  spread.mean = std::accumulate(values.begin(), values.end(), 0.0) / n;
  for (const double value : values) spread.mad += std::abs(value - spread.mean) / n;
  return spread;
}

double Share(std::size_t part, std::size_t whole) {
  return whole == 0 ? 0.0 : static_cast<double>(part) / static_cast<double>(whole);
}

RunShare ShareOfRuns(std::size_t part, std::size_t whole) {
  const int runs = static_cast<int>(part);
  return {runs, Share(part, whole), ExactInterval(runs, static_cast<int>(whole))};
}

double CoverageOf(std::span<const RunRecord> runs, std::optional<bool> RunRecord::*holds) {
  std::size_t held = 0;
  std::size_t answered = 0;
  for (const RunRecord& run : runs) {
    if (!(run.*holds)) continue;
    ++answered;
    if (*(run.*holds)) ++held;
  }
  return Share(held, answered);
}

}  // namespace

PoseError ErrorOf(const Pose& pose, const Pose& truth) {
  const Eigen::Vector3d difference = pose.center_in_world - truth.center_in_world;
  return {difference.norm(),
          difference.head<2>().norm(),
          RotationDistanceDeg(pose.cam_from_world, truth.cam_from_world)};
}

Summary Summarize(std::span<const RunRecord> runs) {
  Summary summary;
  summary.all_runs = static_cast<int>(runs.size());
  std::vector<const RunRecord*> scored;
  std::set<std::string> queries;
  std::set<std::string> scored_queries;
  std::vector<double> seconds;
  std::size_t abstained = 0;
  std::size_t doubtful = 0;
  std::size_t sure = 0;
  double evaluations = 0.0;
  for (const RunRecord& run : runs) {
    if (std::isfinite(run.energy)) ++summary.judged;
    if (run.is_searched) {
      ++summary.searched;
      seconds.push_back(run.seconds);
      evaluations += static_cast<double>(run.evaluations);
    }
    if (!run.pose) ++abstained;
    if (run.status == "doubtful") ++doubtful;
    if (run.pose && run.confidence >= 0.9) ++sure;
    queries.insert(run.query);
    if (!run.has_truth) continue;
    scored.push_back(&run);
    scored_queries.insert(run.query);
  }
  summary.queries = static_cast<int>(queries.size());
  summary.runs = static_cast<int>(scored.size());
  summary.abstained = ShareOfRuns(abstained, runs.size());
  summary.doubtful = ShareOfRuns(doubtful, runs.size());
  summary.confident = ShareOfRuns(sure, runs.size());
  summary.seconds_median = Quantile(seconds, 0.5);
  summary.seconds_p95 = Quantile(seconds, 0.95);
  const double total = std::accumulate(seconds.begin(), seconds.end(), 0.0);
  summary.evaluations_per_second = total > 0.0 ? evaluations / total : 0.0;

  const std::size_t answered = std::count_if(
      scored.begin(), scored.end(), [](const RunRecord* run) { return run->error.has_value(); });
  for (std::size_t t = 0; t < kRecallThresholds.size(); ++t) {
    const std::size_t hits = std::count_if(scored.begin(), scored.end(), [&](const RunRecord* run) {
      return Within(*run, kRecallThresholds[t]);
    });
    summary.recall[t] = Share(hits, scored.size());
    summary.recall_answered[t] = Share(hits, answered);
    summary.recall_ci95[t] =
        WilsonInterval(summary.recall[t], static_cast<int>(scored_queries.size()));
  }

  std::vector<double> translations;
  std::vector<double> rotations;
  std::size_t confident = 0;
  std::size_t confident_right = 0;
  for (const RunRecord* run : scored) {
    if (!run->error) continue;
    translations.push_back(run->error->translation_m);
    rotations.push_back(run->error->rotation_deg);
    if (run->confidence < 0.9) continue;
    ++confident;
    if (Within(*run, kRecallThresholds[2])) ++confident_right;
  }
  summary.translation_m = SpreadOf(translations);
  summary.rotation_deg = SpreadOf(rotations);
  summary.confident_wrong = ShareOfRuns(confident - confident_right, scored.size());
  summary.confident_recall_2m_2deg = Share(confident_right, confident);
  summary.ellipse_coverage = CoverageOf(runs, &RunRecord::ellipse_holds_truth);
  summary.interval_coverage = CoverageOf(runs, &RunRecord::interval_holds_truth);
  return summary;
}

}  // namespace ridgeline
