// SPDX-License-Identifier: Apache-2.0
#include "eval/metrics.h"

#include <gtest/gtest.h>

namespace ridgeline {
namespace {

RunRecord Answered(const std::string& query,
                   double translation_m,
                   double rotation_deg,
                   double confidence) {
  RunRecord run;
  run.query = query;
  run.status = "ok";
  run.has_truth = true;
  run.pose = Pose{};
  run.error = PoseError{translation_m, translation_m, rotation_deg};
  run.confidence = confidence;
  run.evaluations = 100;
  run.seconds = 0.5;
  return run;
}

RunRecord Abstained(const std::string& query) {
  RunRecord run = Answered(query, 0.0, 0.0, 0.1);
  run.status = "abstained";
  run.pose.reset();
  run.error.reset();
  return run;
}

TEST(ErrorOf, IsDistanceAndAngle) {
  const Pose truth{CamFromWorld(ViewAngles{10.0, 0.0, 0.0}), {1.0, 2.0, 3.0}};
  const Pose pose{CamFromWorld(ViewAngles{13.0, 0.0, 0.0}), {4.0, 6.0, 15.0}};
  const PoseError error = ErrorOf(pose, truth);
  EXPECT_NEAR(error.translation_m, 13.0, 1e-12);
  EXPECT_NEAR(error.horizontal_m, 5.0, 1e-12);
  EXPECT_NEAR(error.rotation_deg, 3.0, 1e-9);
}

TEST(Summarize, CountsBothLimitsAndTakesAbstentionsForMisses) {
  const std::vector<RunRecord> runs = {Answered("a", 0.4, 0.9, 0.95),
                                       Answered("b", 1.9, 2.1, 0.95),
                                       Answered("c", 2.0, 2.0, 0.5),
                                       Abstained("d")};
  const Summary summary = Summarize(runs);
  EXPECT_EQ(summary.queries, 4);
  EXPECT_EQ(summary.runs, 4);
  EXPECT_DOUBLE_EQ(summary.recall[0], 0.25);  // 0.5 m, 1 deg
  EXPECT_DOUBLE_EQ(summary.recall[2], 0.5);   // 2 m, 2 deg: a and c
  EXPECT_DOUBLE_EQ(summary.recall_answered[2], 2.0 / 3.0);
  EXPECT_DOUBLE_EQ(summary.recall[3], 0.75);
  EXPECT_DOUBLE_EQ(summary.abstained.share, 0.25);
  EXPECT_DOUBLE_EQ(summary.confident.share, 0.5);
  EXPECT_DOUBLE_EQ(summary.confident_wrong.share, 0.25);  // b
  EXPECT_DOUBLE_EQ(summary.confident_recall_2m_2deg, 0.5);
  EXPECT_DOUBLE_EQ(summary.translation_m.median, 1.9);
  EXPECT_NEAR(summary.translation_m.mean, 4.3 / 3.0, 1e-12);
  // |0.4 - m| + |1.9 - m| + |2.0 - m| with m = 1.4333, divided by 3.
  EXPECT_NEAR(summary.translation_m.mad, 2.0666666666666667 / 3.0, 1e-12);
  EXPECT_DOUBLE_EQ(summary.evaluations_per_second, 200.0);
}

TEST(Summarize, IntervalsHoldTheRecallAndShrinkWithQueries) {
  std::vector<RunRecord> few;
  std::vector<RunRecord> many;
  for (int i = 0; i < 200; ++i) {
    const RunRecord run = Answered(std::to_string(i), i % 2 == 0 ? 1.0 : 8.0, 1.0, 0.9);
    if (i < 10) few.push_back(run);
    many.push_back(run);
  }
  // statsmodels: proportion_confint(5, 10, method="wilson").
  EXPECT_NEAR(Summarize(few).recall_ci95[2].lower, 0.236593, 1e-6);
  const Interval95 wide = Summarize(few).recall_ci95[2];
  const Interval95 narrow = Summarize(many).recall_ci95[2];
  EXPECT_LE(wide.lower, 0.5);
  EXPECT_GE(wide.upper, 0.5);
  // Normal approximation: 1.96 * sqrt(0.25 / 200) = 0.069 either side.
  EXPECT_NEAR(narrow.upper - narrow.lower, 0.139, 0.03);
  EXPECT_GT(wide.upper - wide.lower, narrow.upper - narrow.lower);
}

TEST(Summarize, RunsWithoutTruthAreReportedButNotScored) {
  RunRecord unknown = Answered("x", 0.0, 0.0, 0.9);
  unknown.has_truth = false;
  unknown.error.reset();
  const Summary summary = Summarize(std::vector<RunRecord>{unknown, Answered("a", 1.0, 1.0, 0.9)});
  EXPECT_EQ(summary.all_runs, 2);
  EXPECT_EQ(summary.runs, 1);
  EXPECT_DOUBLE_EQ(summary.recall[2], 1.0);
}

TEST(Summarize, NothingIsAllZero) {
  const Summary summary = Summarize({});
  EXPECT_EQ(summary.runs, 0);
  EXPECT_EQ(summary.recall[2], 0.0);
}

}  // namespace
}  // namespace ridgeline
