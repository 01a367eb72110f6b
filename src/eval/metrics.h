// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "camera/pose.h"
#include "eval/binomial.h"

namespace ridgeline {

// Error of a pose against the truth.
struct PoseError {
  double translation_m = 0.0;  // between the projection centres
  double horizontal_m = 0.0;   // its horizontal part
  double rotation_deg = 0.0;   // angle of the relative rotation
};

PoseError ErrorOf(const Pose& pose, const Pose& truth);

// One query localized once.
struct RunRecord {
  std::string query;
  std::string set;
  int seed = 0;
  std::string status;  // "ok", "doubtful" or "abstained"
  std::string reason;  // of an abstention
  double energy = 1.0;
  double confidence = 0.0;
  std::optional<Pose> pose;  // world frame; absent: abstained
  std::optional<PoseError> error;
  // What the confidence rests on (Localization), and the error of the best pose, withheld or not.
  double posterior_mass = 0.0;
  double explained = 0.0;
  double observed_nat = 0.0;
  double information_nat = 0.0;
  std::optional<double> above_background_nat;
  std::optional<PoseError> candidate_error;
  // 95 % region: whether it holds the truth (position ellipse, heading interval).
  std::optional<bool> ellipse_holds_truth;
  std::optional<bool> interval_holds_truth;
  bool has_truth = false;
  // false: a pose of another system, which says nothing of confidence, evaluations and time.
  bool is_searched = true;
  std::uint64_t evaluations = 0;
  double seconds = 0.0;
};

// Both limits must hold.
struct RecallThreshold {
  const char* name;
  double translation_m;
  double rotation_deg;
};
// Loeper et al., table 1, and finer ones.
inline constexpr std::array<RecallThreshold, 6> kRecallThresholds = {{{"0.5m_1deg", 0.5, 1.0},
                                                                      {"1m_1deg", 1.0, 1.0},
                                                                      {"2m_2deg", 2.0, 2.0},
                                                                      {"3m_3deg", 3.0, 3.0},
                                                                      {"5m_5deg", 5.0, 5.0},
                                                                      {"9m_10deg", 9.0, 10.0}}};

struct Spread {
  double median = 0.0;
  double mean = 0.0;
  double mad = 0.0;  // mean absolute deviation from the mean, as in Loeper et al.
};

// Share of runs with its exact interval: each run counts, since each searches another box.
struct RunShare {
  int runs = 0;
  double share = 0.0;
  Interval95 ci95;
};

// Figures over all runs that have a truth. Abstained runs count as not localized.
struct Summary {
  int queries = 0;
  int runs = 0;      // with truth
  int all_runs = 0;  // with or without truth
  int searched = 0;  // of them, by ridgeline; without any, confidences and times are not known
  int judged = 0;    // of all, with an energy
  std::array<double, kRecallThresholds.size()> recall{};
  std::array<Interval95, kRecallThresholds.size()> recall_ci95{};
  std::array<double, kRecallThresholds.size()> recall_answered{};
  Spread translation_m;  // of the answered
  Spread rotation_deg;
  RunShare abstained;        // of all runs
  RunShare doubtful;         // of all runs: answered, with the doubt named
  RunShare confident;        // of all runs: answered with confidence >= 0.9
  RunShare confident_wrong;  // of the runs with truth: confident and not within 2 m, 2 degrees
  double confident_recall_2m_2deg = 0.0;
  double ellipse_coverage = 0.0;  // share of answered runs
  double interval_coverage = 0.0;
  double seconds_median = 0.0;
  double seconds_p95 = 0.0;
  double evaluations_per_second = 0.0;
};

// Intervals of recalls are Wilson's with the number of queries, since the seeds of one query are
// not independent.
Summary Summarize(std::span<const RunRecord> runs);

}  // namespace ridgeline
