// SPDX-License-Identifier: Apache-2.0
#include "city/raise_roofs.h"

#include <gtest/gtest.h>

#include "support/synthetic_city.h"

namespace ridgeline {
namespace {

testing::House Gabled(double east, double lift) {
  testing::House house;
  house.center = {east, 3.0};
  house.heading_deg = 30.0;
  house.eaves_m = 6.0 + lift;
  house.ridge_m = 9.0 + lift;
  return house;
}

void ExpectSameShape(const CityModel& a, const CityModel& b) {
  ASSERT_EQ(a.vertices.size(), b.vertices.size());
  for (std::size_t i = 0; i < a.vertices.size(); ++i) {
    EXPECT_LT((a.vertices[i] - b.vertices[i]).norm(), 1e-9) << "vertex " << i;
  }
  ASSERT_EQ(a.feature_edges.size(), b.feature_edges.size());
  for (std::size_t i = 0; i < a.feature_edges.size(); ++i) {
    EXPECT_LT((a.feature_edges[i].a - b.feature_edges[i].a).norm(), 1e-9) << "edge " << i;
    EXPECT_LT((a.feature_edges[i].b - b.feature_edges[i].b).norm(), 1e-9) << "edge " << i;
  }
}

TEST(RaiseRoofs, IsTheModelOfAHigherHouse) {
  const CityModel low = testing::MakeCity({Gabled(0.0, 0.0), Gabled(40.0, 0.0)});
  const CityModel high = testing::MakeCity({Gabled(0.0, 0.0), Gabled(40.0, 1.5)});
  ExpectSameShape(WithShiftedRoofs(low, std::vector<RoofShift>{{1, 1.5}}), high);
}

TEST(RaiseRoofs, ShiftsOfOneRoofAddUp) {
  const CityModel low = testing::MakeCity({Gabled(0.0, 0.0)});
  const CityModel lower = testing::MakeCity({Gabled(0.0, -0.75)});
  ExpectSameShape(WithShiftedRoofs(low, std::vector<RoofShift>{{0, -1.0}, {0, 0.25}}), lower);
}

TEST(RaiseRoofs, NoShiftIsTheModelItself) {
  const CityModel model = testing::MakeCity({Gabled(0.0, 0.0)});
  ExpectSameShape(WithShiftedRoofs(model, {}), model);
}

}  // namespace
}  // namespace ridgeline
