// SPDX-License-Identifier: Apache-2.0
#include "input/prior_pose.h"

#include <gtest/gtest.h>

#include "base/error.h"

namespace ridgeline {
namespace {

const Eigen::Vector3d kOrigin(690000.0, 5335000.0, 500.0);

HeightGrid Flat() { return {{0.0, 0.0}, 10.0, 2, 2, {12.0f, 12.0f, 12.0f, 12.0f}}; }

TEST(PoseOfPrior, OpenPartsAreLevelNorthAndAboveTheTerrain) {
  PosePrior prior;
  prior.position_in_world = {690005.0, 5335005.0};
  const HeightGrid terrain = Flat();
  const Pose pose = PoseOfPrior(prior, &terrain, kOrigin, 1.5).value();
  EXPECT_NEAR((pose.center_in_world - Eigen::Vector3d(690005.0, 5335005.0, 513.5)).norm(), 0, 1e-9);
  const ViewAngles angles = ViewAnglesOf(pose.cam_from_world);
  EXPECT_NEAR(HeadingDifferenceDeg(angles.heading_deg, 0.0), 0.0, 1e-9);
  EXPECT_NEAR(angles.pitch_deg, 0.0, 1e-9);
  EXPECT_NEAR(angles.roll_deg, 0.0, 1e-9);
}

TEST(PoseOfPrior, AHeightIsTakenAsItIs) {
  PosePrior prior;
  prior.position_in_world = {690005.0, 5335005.0};
  prior.height_in_world = 530.0;
  EXPECT_EQ(PoseOfPrior(prior, nullptr, kOrigin, 1.5)->center_in_world.z(), 530.0);
}

TEST(PoseOfPrior, NoHeightAndNoTerrainIsNoPose) {
  PosePrior prior;
  prior.position_in_world = {690005.0, 5335005.0};
  EXPECT_FALSE(PoseOfPrior(prior, nullptr, kOrigin, 1.5).has_value());
  const HeightGrid terrain = Flat();
  prior.position_in_world.x() += 100.0;  // off the terrain
  EXPECT_FALSE(PoseOfPrior(prior, &terrain, kOrigin, 1.5).has_value());
}

TEST(AssumptionsOf, NamesEachOpenPartOnce) {
  PosePrior prior;
  std::vector<Assumption> all = AssumptionsOf(prior, 1.7, "prior.json");
  ASSERT_EQ(all.size(), 3u);
  EXPECT_EQ(TextOf(all[0]), "height: terrain + 1.7 m assumed");
  EXPECT_EQ(all[0].source, "prior.json");
  EXPECT_EQ(all[1].what, "heading");
  EXPECT_EQ(all[2].what, "pitch, roll");
  prior.height_in_world = 500.0;
  prior.heading_deg = 10.0;
  prior.pitch_deg = 1.0;
  all = AssumptionsOf(prior, 1.7, "prior.json");
  ASSERT_EQ(all.size(), 1u);
  EXPECT_EQ(all[0].what, "roll");
  prior.roll_deg = 0.0;
  EXPECT_TRUE(AssumptionsOf(prior, 1.7, "prior.json").empty());
}

TEST(AssumptionsOf, HeadingsThatMayBeRadians) {
  PosePrior prior;
  const auto doubt = [&](double heading) {
    prior.heading_deg = heading;
    return TextOf(AssumptionsOf(prior, 1.7, "prior.json")[1]);
  };
  EXPECT_EQ(doubt(0.5235988), "heading: 0.523599 deg as written; if that is radians, write 30.0");
  EXPECT_EQ(doubt(360.0 - 1.5707963),
            "heading: -1.5708 deg as written; if that is radians, write 270.0");
  for (const double plain : {0.0, 0.5, 3.25, 30.1234567, 359.5}) {
    EXPECT_EQ(doubt(plain).find("radians"), std::string::npos) << plain;
  }
}

TEST(CheckPosition, LatitudeAndLongitudeAreNoMetres) {
  PosePrior prior;
  prior.position_in_world = {48.148912, 11.567891};
  try {
    CheckPosition(prior, Crs{25832, 0}, "prior.json");
    FAIL();
  } catch (const InputError& e) {
    EXPECT_STREQ(e.what(),
                 "prior.json: position: got 48.148912, 11.567891, a latitude and a longitude as it "
                 "seems, expected easting, northing in EPSG:25832 [m] (such as 690994.27, "
                 "5336040.50)");
  }
  CheckPosition(prior, Crs{}, "prior.json");  // a model in a frame of its own
  prior.position_in_world = {690994.27, 5336040.5};
  CheckPosition(prior, Crs{25832, 0}, "prior.json");
}

TEST(AssumptionOf, SplitsAtTheFirstColon) {
  const Assumption assumption = AssumptionOf("heading: 3.0 deg: north", "photo.jpg");
  EXPECT_EQ(assumption.what, "heading");
  EXPECT_EQ(assumption.value, "3.0 deg: north");
  EXPECT_EQ(TextOf(assumption), "heading: 3.0 deg: north");
}

}  // namespace
}  // namespace ridgeline
