// SPDX-License-Identifier: Apache-2.0
#include "study/explore.h"

#include <gtest/gtest.h>

#include "study/study.h"
#include "support/street_study.h"

namespace ridgeline {
namespace {

TEST(Explore, IsNowhereWorseThanTheMapAndFinerThanIt) {
  const ::ridgeline::testing::StreetStudy street;
  StudyOptions options;
  options.classes = {5};
  options.explore = true;
  const std::vector<std::size_t> queries = {0};
  const auto studies = RunStudy(BenchQueries(PerturbedProtocol("2,2,0,6"), street.dataset(), {}),
                                queries,
                                street.localizer(),
                                ChooseScores({"skyline_l1", "line_energy"}, {}),
                                options,
                                {});
  ASSERT_EQ(studies.size(), 2u);
  for (const ScoreStudy& study : studies) {
    const EnergyMap& map = study.map;
    const EnergyMap& fine = study.explored->map;
    EXPECT_EQ(fine.columns, 9);
    EXPECT_EQ(fine.spacing_m, 0.5);
    EXPECT_LT((fine.first - map.first).norm(), 1e-9);
    for (int row = 0; row < map.rows; ++row) {
      for (int column = 0; column < map.columns; ++column) {
        // The map's headings are among those tried, with the prior's pitch and roll. A float's
        // rounding apart.
        EXPECT_LE(fine.At(2 * column, 2 * row), map.At(column, row) + 1e-6);
      }
    }
    const double pitch_deg = *study.prior.pitch_deg;
    for (const float pitch : study.explored->pitch_deg) EXPECT_NEAR(pitch, pitch_deg, 3.0 + 1e-6);
  }
}

}  // namespace
}  // namespace ridgeline
