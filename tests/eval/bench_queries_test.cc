// SPDX-License-Identifier: Apache-2.0
#include "eval/bench_queries.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/error.h"
#include "support/street_study.h"

namespace ridgeline {
namespace {

class BenchQueriesOfAStreet : public ::testing::Test {
 protected:
  std::string ErrorWith(const Protocol& protocol) const {
    try {
      BenchQueries(protocol, street_.dataset(), {});
    } catch (const InputError& e) {
      return e.what();
    }
    return "no error";
  }

  ::ridgeline::testing::StreetStudy street_;  // two queries, the second without truth
};

TEST_F(BenchQueriesOfAStreet, ThoseWithoutWhatAProtocolNeedsAreLeftOut) {
  const BenchQueries queries(FindProtocol("known-tilt"), street_.dataset(), {});
  EXPECT_EQ(queries.usable(), std::vector<std::size_t>{0});
}

TEST_F(BenchQueriesOfAStreet, NoPriorAtAllIsAnError) {
  try {
    BenchQueries queries(street_.dataset());
    FAIL();
  } catch (const InputError& e) {
    EXPECT_THAT(e.what(), ::testing::HasSubstr("--protocol"));
  }
}

TEST_F(BenchQueriesOfAStreet, TerrainHeightsNeedATerrain) {
  // Neither a terrain model nor a city model in a file.
  EXPECT_THAT(ErrorWith(FindProtocol("phone")), ::testing::Not(::testing::StrEq("no error")));
  EXPECT_THAT(ErrorWith(FindProtocol("known-tilt")), ::testing::StrEq("no error"));
}

TEST_F(BenchQueriesOfAStreet, PlacesAreTruthsOrElsePriors) {
  Dataset dataset = street_.dataset();
  dataset.queries[1].prior = PosePrior{};
  dataset.queries[1].prior->position_in_world = {7.0, 8.0};
  const std::vector<Eigen::Vector2d> places = PlacesOf(dataset);
  ASSERT_EQ(places.size(), 2u);
  EXPECT_EQ(places[0], dataset.queries[0].truth->center_in_world.head<2>());
  EXPECT_EQ(places[1], Eigen::Vector2d(7.0, 8.0));
}

}  // namespace
}  // namespace ridgeline
