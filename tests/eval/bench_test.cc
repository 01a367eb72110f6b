// SPDX-License-Identifier: Apache-2.0
#include "eval/bench.h"

#include <gtest/gtest.h>

#include "eval/bench_queries.h"
#include "support/street_study.h"

namespace ridgeline {
namespace {

class Bench : public ::testing::Test {
 protected:
  BenchRun RunOf(const BenchQueries& queries) const {
    return RunBench(queries, street_.localizer(), {}, {}).front();
  }

  ::ridgeline::testing::StreetStudy street_;
};

TEST_F(Bench, TheAnswerFollowsFromPicturePriorAndBoxAlone) {
  const BenchQueries queries(PerturbedProtocol("4,4,0,10"), street_.dataset(), {});
  const BenchRun run = RunOf(queries);
  ASSERT_TRUE(run.localization.pose.has_value());
  LocalizationInput input;
  input.picture = cv::imread(street_.dataset().queries[0].image.string());
  input.camera = *street_.dataset().queries[0].camera;
  input.prior = run.prior;
  const Localization again = street_.localizer().Localize(input, run.ranges, 1, 0);
  EXPECT_EQ(run.localization.pose->center_in_world, again.pose->center_in_world);
  EXPECT_EQ(run.localization.pose->cam_from_world.coeffs(), again.pose->cam_from_world.coeffs());
}

TEST_F(Bench, TheBoxIsCentredOnThePriorNotOnTheTruth) {
  const BenchRun run = RunOf({PerturbedProtocol("4,4,0,10"), street_.dataset(), {}});
  const EnergyMap& map = run.localization.map;
  const Eigen::Vector2d middle =
      map.first + 0.5 * map.spacing_m * Eigen::Vector2d(map.columns - 1, map.rows - 1);
  EXPECT_LT((middle - run.prior.position_in_world).norm(), 1e-6);
  const Pose& truth = *street_.dataset().queries[0].truth;
  EXPECT_GT((middle - truth.center_in_world.head<2>()).norm(), 0.1);
}

TEST_F(Bench, AnotherTruthChangesErrorsButNoAnswer) {
  Dataset dataset = street_.dataset();
  dataset.queries[0].prior = PosePrior{{690001.5, 5334995.0}, 501.7, 8.0, 3.0, 0.0};
  const BenchRun run = RunOf(BenchQueries(dataset));
  dataset.queries[0].truth->center_in_world.x() += 3.0;
  const BenchRun moved = RunOf(BenchQueries(dataset));
  ASSERT_TRUE(run.localization.pose.has_value());
  EXPECT_EQ(run.localization.pose->center_in_world, moved.localization.pose->center_in_world);
  EXPECT_EQ(run.localization.confidence, moved.localization.confidence);
  EXPECT_NE(run.record.error->translation_m, moved.record.error->translation_m);
}

}  // namespace
}  // namespace ridgeline
