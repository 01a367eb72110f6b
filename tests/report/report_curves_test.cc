// SPDX-License-Identifier: Apache-2.0
#include "report/report_curves.h"

#include <gtest/gtest.h>

namespace ridgeline {
namespace {

ReportRun MakeRun(const std::string& id, double translation_m, double confidence) {
  ReportRun run;
  run.id = id;
  run.translation_m = translation_m;
  run.rotation_deg = 0.5;
  run.confidence = confidence;
  run.outcome = translation_m <= 2.0 ? ReportOutcome::kRight : ReportOutcome::kWrong;
  return run;
}

TEST(RecallCurve, CountsAbstainedRunsAsMisses) {
  std::vector<ReportRun> runs = {
      MakeRun("a", 0.1, 0.9), MakeRun("b", 4.0, 0.2), MakeRun("c", 0.1, 0.9)};
  runs[2].outcome = ReportOutcome::kAbstained;
  const auto curve = RecallCurve(runs);
  ASSERT_EQ(curve.size(), 40u);
  EXPECT_NEAR(curve[7].x, 2.0, 1e-12);
  EXPECT_NEAR(curve[7].share, 1.0 / 3.0, 1e-12);
  EXPECT_NEAR(curve.back().share, 2.0 / 3.0, 1e-12);
  EXPECT_LE(curve[7].lower, curve[7].share);
  EXPECT_GE(curve[7].upper, curve[7].share);
}

TEST(RecallCurve, IsEmptyWithoutTruth) {
  ReportRun run;
  run.outcome = ReportOutcome::kUnknown;
  EXPECT_TRUE(RecallCurve(std::vector<ReportRun>{run}).empty());
}

TEST(Reliability, PutsRunsIntoBinsOfConfidence) {
  const std::vector<ReportRun> runs = {MakeRun("a", 0.1, 0.95),
                                       MakeRun("b", 3.0, 0.91),
                                       MakeRun("c", 3.0, 0.1),
                                       MakeRun("d", 0.2, 1.0)};
  const auto bins = Reliability(runs, 10);
  ASSERT_EQ(bins.size(), 2u);
  EXPECT_EQ(bins[0].count, 1);
  EXPECT_EQ(bins[1].count, 3);
  EXPECT_NEAR(bins[1].share, 2.0 / 3.0, 1e-12);
  EXPECT_NEAR(bins[1].x, (0.95 + 0.91 + 1.0) / 3.0, 1e-12);
}

}  // namespace
}  // namespace ridgeline
