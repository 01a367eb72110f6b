// SPDX-License-Identifier: Apache-2.0
#include "eval/pose_json.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace ridgeline {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

TEST(PoseJson, NumbersHaveNoRoundingNoise) {
  Localization found;
  found.status = LocalizationStatus::kOk;
  found.pose = Pose{CamFromWorld(ViewAngles{112.3, 0.7, 0.1}), {690909.21500001, 5335940.1, 517.3}};
  found.energy = 0.1 + 0.2;
  const std::string text = PoseJson("photo.jpg", found, CityModel{}, {});
  EXPECT_THAT(text, HasSubstr("690909.215,"));
  EXPECT_THAT(text, HasSubstr("5335940.1,"));
  EXPECT_THAT(text, HasSubstr("\"heading_deg\": 112.3,"));
  EXPECT_THAT(text, HasSubstr("\"energy\": 0.3,"));
  EXPECT_THAT(text, Not(HasSubstr("00000")));
  EXPECT_THAT(text, Not(HasSubstr("99999")));
}

}  // namespace
}  // namespace ridgeline
