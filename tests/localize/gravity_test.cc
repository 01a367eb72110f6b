// SPDX-License-Identifier: Apache-2.0
#include "localize/gravity.h"

#include <gtest/gtest.h>

#include "base/random.h"

namespace ridgeline {
namespace {

const PinholeCamera kCamera{960, 720, 900.0, 900.0, 480.0, 360.0};

// Images of vertical lines all around, with a third as many lines of any direction.
std::vector<LineSegment> Scene(const ViewAngles& view, std::uint64_t seed) {
  Random random(seed, HashText("Gravity"));
  const Eigen::Quaterniond q = CamFromWorld(view);
  std::vector<LineSegment> segments;
  while (segments.size() < 90) {
    const Eigen::Vector3d foot(random.Uniform(-15, 15), random.Uniform(8, 40),
                               random.Uniform(-2, 10));
    const Eigen::Vector3d a = q * foot;
    const Eigen::Vector3d b = q * (foot + Eigen::Vector3d(0, 0, 3));
    if (a.z() < 1.0 || b.z() < 1.0) continue;
    segments.push_back({kCamera.ImageFromCamera(a).cast<float>(),
                        kCamera.ImageFromCamera(b).cast<float>(), 1.0f});
  }
  for (int i = 0; i < 30; ++i) {
    const Eigen::Vector2f a(random.Uniform(0, 960), random.Uniform(0, 720));
    const Eigen::Vector2f d(random.Uniform(-60, 60), random.Uniform(-60, 60));
    segments.push_back({a, a + d, 1.0f});
  }
  return segments;
}

TEST(FindTilts, FindsPitchAndRollFromVerticalLines) {
  for (const auto& [pitch, roll] : {std::pair{3.0, -2.0}, {-4.0, 4.5}, {0.0, 0.0}}) {
    const auto tilts =
        FindTilts(Scene({0.0, 10.0 + pitch, roll}, 1), kCamera, {0.0, 10.0, 0.0}, 5.0, 5.0, 1.0, 2);
    ASSERT_FALSE(tilts.empty());
    EXPECT_NEAR(tilts[0].pitch_deg, 10.0 + pitch, 0.26);  // the grid's step
    EXPECT_NEAR(tilts[0].roll_deg, roll, 0.26);
  }
}

TEST(FindTilts, FixedAnglesStayAsTheyAre) {
  const auto segments = Scene({0.0, 3.0, -2.0}, 1);
  const auto fixed = FindTilts(segments, kCamera, {0.0, 1.0, 2.0}, 0.0, 0.0, 1.0, 3);
  ASSERT_EQ(fixed.size(), 1u);
  EXPECT_EQ(fixed[0].pitch_deg, 1.0);
  EXPECT_EQ(fixed[0].roll_deg, 2.0);
  for (const Tilt& tilt : FindTilts(segments, kCamera, {0.0, 1.0, 2.0}, 5.0, 0.0, 1.0, 3)) {
    EXPECT_EQ(tilt.roll_deg, 2.0);
  }
}

TEST(FindTilts, WithoutLinesTheCentreIsTheAnswer) {
  const auto tilts = FindTilts({}, kCamera, {0.0, 1.0, 2.0}, 5.0, 5.0, 1.0, 3);
  ASSERT_EQ(tilts.size(), 1u);
  EXPECT_EQ(tilts[0].pitch_deg, 1.0);
}

TEST(FindTilts, HypothesesAreApart) {
  const auto tilts = FindTilts(Scene({}, 2), kCamera, {}, 5.0, 5.0, 2.0, 4);
  ASSERT_EQ(tilts.size(), 4u);
  for (std::size_t i = 0; i < tilts.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      EXPECT_GE(std::hypot(tilts[i].pitch_deg - tilts[j].pitch_deg,
                           tilts[i].roll_deg - tilts[j].roll_deg),
                2.0);
    }
  }
}

}  // namespace
}  // namespace ridgeline
