// SPDX-License-Identifier: Apache-2.0
#include "eval/protocol.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "base/error.h"

namespace ridgeline {
namespace {

const Pose kTruth{CamFromWorld(ViewAngles{350.0, 3.0, -2.0}), {1000.0, 2000.0, 301.5}};

DrawContext OnFoot() {
  DrawContext context;
  context.height_above_terrain = 1.5;
  context.set_offset_m = 2.4;
  context.is_free = [](const Eigen::Vector2d&) { return true; };
  return context;
}

TEST(Protocols, AreNamedAndAWrongNameIsToldTheNearest) {
  for (const Protocol& protocol : Protocols()) {
    EXPECT_EQ(FindProtocol(protocol.name).words, protocol.words);
  }
  try {
    FindProtocol("fone");
    FAIL();
  } catch (const InputError& e) {
    EXPECT_NE(std::string(e.what()).find("phone"), std::string::npos) << e.what();
  }
}

TEST(Protocols, KnownTiltIsThePerturbationOfTheOldTables) {
  const SearchStart named = DrawStart(FindProtocol("known-tilt"), kTruth, OnFoot(), 3, "a");
  const SearchStart numbers = DrawStart(PerturbedProtocol("10,10,0,20"), kTruth, OnFoot(), 3, "a");
  EXPECT_EQ(named.prior.position_in_world, numbers.prior.position_in_world);
  EXPECT_EQ(named.prior.heading_deg, numbers.prior.heading_deg);
  EXPECT_NEAR(*named.prior.pitch_deg, 3.0, 1e-9);
  EXPECT_NEAR(*named.prior.height_in_world, 301.5, 1e-12);
  EXPECT_EQ(named.ranges.pitch_deg, 0.0);
}

TEST(Protocols, PhoneTellsNeitherHeightNorHeading) {
  double farthest_m = 0.0;
  double most_tilt_deg = 0.0;
  for (int seed = 0; seed < 500; ++seed) {
    const SearchStart start = DrawStart(FindProtocol("phone"), kTruth, OnFoot(), seed, "a");
    EXPECT_FALSE(start.prior.height_in_world.has_value());
    EXPECT_FALSE(start.prior.heading_deg.has_value());
    // The truth is in the box.
    const Eigen::Vector2d off = start.prior.position_in_world - kTruth.center_in_world.head<2>();
    farthest_m = std::max(farthest_m, off.cwiseAbs().maxCoeff());
    EXPECT_LE(off.cwiseAbs().maxCoeff(), start.ranges.east_m);
    most_tilt_deg = std::max(most_tilt_deg, std::abs(*start.prior.pitch_deg - 3.0));
    EXPECT_LE(std::abs(*start.prior.roll_deg + 2.0), start.ranges.roll_deg + 1e-9);
    // Hands are 1.2 to 2.0 m above ground, and the terrain model is off by some decimetres.
    EXPECT_LE(start.ranges.camera_height_m - start.ranges.height_m, 0.9);
    EXPECT_GE(start.ranges.camera_height_m + start.ranges.height_m, 2.3);
  }
  EXPECT_GT(farthest_m, 19.0);
  EXPECT_LE(most_tilt_deg, 8.0 + 1e-9);
  EXPECT_GT(most_tilt_deg, 7.5);
}

TEST(Protocols, PicturesFromTheAirKnowTheirHeightRoughly) {
  DrawContext context = OnFoot();
  context.height_above_terrain = 40.0;
  const SearchStart start = DrawStart(FindProtocol("phone"), kTruth, context, 1, "a");
  ASSERT_TRUE(start.prior.height_in_world.has_value());
  EXPECT_LE(std::abs(*start.prior.height_in_world - 301.5), start.ranges.height_m);
}

TEST(Protocols, PaperHasOneHeightForTheSetAndIsLevel) {
  const SearchStart start = DrawStart(FindProtocol("paper"), kTruth, OnFoot(), 1, "a");
  EXPECT_FALSE(start.prior.height_in_world.has_value());
  EXPECT_EQ(start.ranges.camera_height_m, 2.4);
  EXPECT_EQ(start.ranges.height_m, 0.0);
  EXPECT_FALSE(start.prior.pitch_deg.has_value());
  EXPECT_LE(std::abs(HeadingDifferenceDeg(*start.prior.heading_deg, 350.0)), 20.0);
}

TEST(Protocols, OutsideLeavesTheTruthOutOfTheBox) {
  std::vector<int> quadrants(4, 0);
  for (int seed = 0; seed < 400; ++seed) {
    const SearchStart start = DrawStart(FindProtocol("outside"), kTruth, OnFoot(), seed, "a");
    const Eigen::Vector2d off = start.prior.position_in_world - kTruth.center_in_world.head<2>();
    EXPECT_GE(off.norm(), 25.0 - 1e-9);
    EXPECT_LE(off.norm(), 40.0 + 1e-9);
    EXPECT_GT(off.cwiseAbs().maxCoeff(), start.ranges.east_m);
    ++quadrants[(off.x() > 0.0 ? 1 : 0) + (off.y() > 0.0 ? 2 : 0)];
  }
  for (const int count : quadrants) EXPECT_GT(count, 60);
}

TEST(Protocols, OutsideTakesPlacesWhereACameraCanStand) {
  DrawContext context = OnFoot();
  context.is_free = [](const Eigen::Vector2d& place) { return place.x() > 1000.0; };
  for (int seed = 0; seed < 50; ++seed) {
    const SearchStart start = DrawStart(FindProtocol("outside"), kTruth, context, seed, "a");
    EXPECT_GT(start.prior.position_in_world.x(), 1000.0);
  }
}

TEST(Protocols, ElsewhereSearchesThePlacesOfTheOtherWorld) {
  const std::vector<Eigen::Vector2d> places = {{5000.0, 100.0}, {6000.0, 200.0}};
  const auto terrain = [](const Eigen::Vector2d&) -> std::optional<double> { return 50.0; };
  int at_first = 0;
  for (int seed = 0; seed < 100; ++seed) {
    const SearchStart start = DrawElsewhere(FindProtocol("elsewhere"),
                                            ViewAngles{0.0, 3.0, -2.0},
                                            places,
                                            terrain,
                                            OnFoot(),
                                            seed,
                                            "a");
    const double to_first = (start.prior.position_in_world - places[0]).cwiseAbs().maxCoeff();
    const double to_second = (start.prior.position_in_world - places[1]).cwiseAbs().maxCoeff();
    EXPECT_LE(std::min(to_first, to_second), 10.0);
    at_first += to_first < to_second ? 1 : 0;
    EXPECT_FALSE(start.prior.heading_deg.has_value());
    EXPECT_FALSE(start.prior.height_in_world.has_value());
    EXPECT_LE(std::abs(*start.prior.pitch_deg - 3.0), 8.0 + 1e-9);
  }
  EXPECT_GT(at_first, 30);
  EXPECT_LT(at_first, 70);
}

TEST(Protocols, DrawsDependOnSeedAndIdAlone) {
  for (const Protocol& protocol : Protocols()) {
    if (protocol.place == PriorPlace::kOtherWorld) continue;
    const SearchStart once = DrawStart(protocol, kTruth, OnFoot(), 1, "a");
    const SearchStart again = DrawStart(protocol, kTruth, OnFoot(), 1, "a");
    const SearchStart other = DrawStart(protocol, kTruth, OnFoot(), 2, "a");
    EXPECT_EQ(once.prior.position_in_world, again.prior.position_in_world) << protocol.name;
    EXPECT_NE(once.prior.position_in_world, other.prior.position_in_world) << protocol.name;
  }
}

}  // namespace
}  // namespace ridgeline
