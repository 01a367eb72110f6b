// SPDX-License-Identifier: Apache-2.0
#include "localize/background.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <mutex>

#include "support/synthetic_city.h"

namespace ridgeline {
namespace {

// Writes down where it was asked, and prefers a heading of 120 degrees.
class Recorder final : public Score {
 public:
  ViewParts parts() const override { return {.edges_and_skyline = false, .surfaces = false}; }
  double LogRatio(const PositionView&, const Pose& pose, Workspace&) const override {
    const std::lock_guard lock(mutex_);
    places_.push_back(pose.center_in_world);
    const double heading = ViewAnglesOf(pose.cam_from_world).heading_deg;
    return 50.0 - std::abs(HeadingDifferenceDeg(heading, 120.0)) + 0.01 * pose.center_in_world.x();
  }
  const std::vector<Eigen::Vector3d>& places() const { return places_; }

 private:
  mutable std::mutex mutex_;
  mutable std::vector<Eigen::Vector3d> places_;
};

class BackgroundOfATown : public ::testing::Test {
 protected:
  BackgroundOfATown()
      : model_(testing::MakeCity(testing::TownHouses(3, 3, 7))),
        footprints_(model_),
        scene_(model_, nullptr, {}) {
    prior_.position_in_world = {60.0, 60.0};
    prior_.height_in_world = 1.7;
    prior_.heading_deg = 10.0;
    prior_.pitch_deg = prior_.roll_deg = 0.0;
    ranges_.heading_deg = 180.0;
  }

  std::vector<BackgroundPose> Look(const Recorder& recorder, int count, int threads) {
    const PoseSpace space(prior_, ranges_, scene_, nullptr, footprints_);
    const PoseScorer scorer(recorder, scene_, space, camera_, 0.5);
    const std::vector<Tilt> tilts(1);
    return BackgroundOf(scorer, tilts, 2.0, count, threads, evaluations_);
  }

  CityModel model_;
  Footprints footprints_;
  Scene scene_;
  PosePrior prior_;
  PoseSpaceOptions ranges_;
  std::uint64_t evaluations_ = 0;
  PinholeCamera camera_{64, 48, 50.0, 50.0, 32.0, 24.0};
};

TEST_F(BackgroundOfATown, LooksInAllHeadingsFromPlacesOutsideOfTheBox) {
  const Recorder recorder;
  const std::vector<BackgroundPose> background = Look(recorder, 20, 1);
  ASSERT_EQ(background.size(), 20u);
  EXPECT_EQ(evaluations_, 20u * 180u);
  for (const BackgroundPose& pose : background) {
    const double heading = pose.space.AnglesAt(pose.best.offset).heading_deg;
    EXPECT_NEAR(HeadingDifferenceDeg(heading, 120.0), 0.0, 1.0);
    EXPECT_DOUBLE_EQ(pose.best.log_ratio,
                     50.0 - std::abs(HeadingDifferenceDeg(heading, 120.0)) +
                         0.01 * pose.space.PositionAt(0.0, 0.0, 0.0)->x());
  }
  for (const Eigen::Vector3d& place : recorder.places()) {
    const Eigen::Vector2d offset = place.head<2>() - prior_.position_in_world;
    EXPECT_GT(offset.cwiseAbs().maxCoeff(), ranges_.east_m);
    EXPECT_FALSE(footprints_.Contains(place.head<2>()));
    EXPECT_DOUBLE_EQ(place.z(), 1.7);
  }
}

TEST_F(BackgroundOfATown, IsTheSameOnAnyNumberOfThreads) {
  const Recorder one;
  const Recorder many;
  const auto log_ratios = [](const std::vector<BackgroundPose>& background) {
    std::vector<double> all;
    for (const BackgroundPose& pose : background) all.push_back(pose.best.log_ratio);
    return all;
  };
  const std::vector<double> expected = log_ratios(Look(one, 30, 1));
  EXPECT_TRUE(std::is_sorted(expected.rbegin(), expected.rend()));
  EXPECT_EQ(log_ratios(Look(many, 30, 8)), expected);
}

TEST_F(BackgroundOfATown, ABoxOfTheWholeTownLeavesNone) {
  ranges_.east_m = ranges_.north_m = 500.0;
  const Recorder recorder;
  EXPECT_TRUE(Look(recorder, 20, 1).empty());
}

}  // namespace
}  // namespace ridgeline
