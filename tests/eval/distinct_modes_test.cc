// SPDX-License-Identifier: Apache-2.0
#include "eval/distinct_modes.h"

#include <gtest/gtest.h>

namespace ridgeline {
namespace {

PoseMode ModeAt(double east, double heading_deg, double energy) {
  Pose pose;
  pose.center_in_world = {east, 0.0, 0.0};
  pose.cam_from_world = Eigen::AngleAxisd(heading_deg * M_PI / 180.0, Eigen::Vector3d::UnitY());
  return {pose, energy};
}

TEST(DistinctModes, LeavesOutWhatIsWithinTwoMetresAndTwoDegreesOfABetterOne) {
  const std::vector<PoseMode> modes = {ModeAt(0.0, 0.0, 0.1),
                                       ModeAt(1.0, 1.0, 0.2),    // the first again
                                       ModeAt(0.0, 5.0, 0.3),    // another direction
                                       ModeAt(3.0, 0.0, 0.4),    // another place
                                       ModeAt(3.5, 0.5, 0.5)};   // that place again
  const std::vector<PoseMode> distinct = DistinctModes(modes);
  ASSERT_EQ(distinct.size(), 3u);
  EXPECT_EQ(distinct[0].energy, 0.1);
  EXPECT_EQ(distinct[1].energy, 0.3);
  EXPECT_EQ(distinct[2].energy, 0.4);
}

TEST(DistinctModes, NoneOfNone) { EXPECT_TRUE(DistinctModes({}).empty()); }

}  // namespace
}  // namespace ridgeline
