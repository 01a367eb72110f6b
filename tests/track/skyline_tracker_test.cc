// SPDX-License-Identifier: Apache-2.0
#include "track/skyline_tracker.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "base/random.h"
#include "score/sky_score.h"
#include "support/synthetic_city.h"

namespace ridgeline {
namespace {

PinholeCamera Camera() { return {320, 240, 280.0, 280.0, 160.0, 120.0}; }

// A walk along a street of a small town, drawn from its model: what is found can be compared with
// what was drawn.
class SkylineTracking : public ::testing::Test {
 protected:
  SkylineTracking()
      : model_(testing::MakeCity(testing::TownHouses(5, 5, 3))),
        scene_(model_, nullptr, ProjectionOptions{}) {}

  static Pose Truth(int frame) {
    return {CamFromWorld(ViewAngles{20.0 + 1.5 * frame, 8.0 + 0.3 * (frame % 3), 1.0}),
            {60.0, 90.0 + 0.3 * frame, 1.6}};
  }

  // The sensors are off by as much in every frame.
  static Pose Sensors(int frame) {
    const Pose truth = Truth(frame);
    const ViewAngles a = ViewAnglesOf(truth.cam_from_world);
    return {CamFromWorld(ViewAngles{a.heading_deg + 9.0, a.pitch_deg - 0.8, a.roll_deg + 0.5}),
            truth.center_in_world + Eigen::Vector3d(2.5, -2.0, 0.0)};
  }

  cv::Mat Picture(const Pose& pose) const {
    const PinholeCamera camera = Camera();
    std::vector<float> rows(static_cast<std::size_t>(camera.width));
    SkylineRows(SkylineDirections(scene_.SkylineFrom(pose.center_in_world, Sector{})),
                camera,
                pose.cam_from_world.toRotationMatrix().cast<float>(),
                rows);
    cv::Mat picture(camera.height, camera.width, CV_8UC3);
    Random random(HashText("SkylineTracking"), 0);
    for (int y = 0; y < picture.rows; ++y) {
      for (int x = 0; x < picture.cols; ++x) {
        const bool sky = static_cast<float>(y) < rows[static_cast<std::size_t>(x)];
        const double noise = 2.0 * random.Normal();
        for (int c = 0; c < 3; ++c) {
          picture.at<cv::Vec3b>(y, x)[c] =
              cv::saturate_cast<std::uint8_t>((sky ? 225.0 : 110.0 + 20.0 * c) + noise);
        }
      }
    }
    return picture;
  }

  static double HeadingError(const SkylineFrame& frame, int index) {
    return std::abs(HeadingDifferenceDeg(ViewAnglesOf(frame.match.best.cam_from_world).heading_deg,
                                         ViewAnglesOf(Truth(index).cam_from_world).heading_deg));
  }

  CityModel model_;
  Scene scene_;
};

TEST_F(SkylineTracking, CarriesTheCorrectionFromFrameToFrame) {
  SkylineTracker tracker(scene_, SkylineTrackOptions{});
  for (int i = 0; i < 7; ++i) {
    const SkylineFrame frame = tracker.Track(Picture(Truth(i)), Camera(), Sensors(i));
    ASSERT_TRUE(frame.match.pose) << "frame " << i << ": " << frame.match.reason;
    EXPECT_LT(HeadingError(frame, i), 1.5) << "frame " << i;
    const double start_off =
        std::abs(HeadingDifferenceDeg(ViewAnglesOf(frame.start.cam_from_world).heading_deg,
                                      ViewAnglesOf(Truth(i).cam_from_world).heading_deg));
    if (i == 0) {
      EXPECT_NEAR(start_off, 9.0, 1e-6);
    } else {
      EXPECT_LT(start_off, 1.5);
    }
    EXPECT_LT(frame.at_best.used_px, frame.by_sensors.used_px);
    EXPECT_LT(frame.at_best.plain_px, frame.by_sensors.plain_px);
  }
}

TEST_F(SkylineTracking, KeyFramesComeAtTheirInterval) {
  SkylineTrackOptions options;
  options.keyframe_every = 3;
  options.match.max_heading_sigma_deg = 90.0;
  SkylineTracker tracker(scene_, options);
  for (int i = 0; i < 7; ++i) {
    const SkylineFrame frame = tracker.Track(Picture(Truth(i)), Camera(), Sensors(i));
    EXPECT_EQ(frame.method, i % 3 == 0 ? SkylineMatch::k6dof : SkylineMatch::k3d) << "frame " << i;
  }
}

TEST_F(SkylineTracking, FromTheSensorsEveryFrameStandsAlone) {
  SkylineTrackOptions options;
  options.start = "sensors";
  SkylineTracker tracker(scene_, options);
  tracker.Track(Picture(Truth(0)), Camera(), Sensors(0));
  const SkylineFrame second = tracker.Track(Picture(Truth(1)), Camera(), Sensors(1));
  SkylineTracker fresh(scene_, options);
  const SkylineFrame alone = fresh.Track(Picture(Truth(1)), Camera(), Sensors(1));
  EXPECT_EQ(second.method, SkylineMatch::k3d);
  EXPECT_EQ(second.start.center_in_world, Sensors(1).center_in_world);
  EXPECT_EQ(second.match.best.cam_from_world.coeffs(), alone.match.best.cam_from_world.coeffs());
}

TEST_F(SkylineTracking, AFailureForgetsTheCorrection) {
  SkylineTracker tracker(scene_, SkylineTrackOptions{});
  ASSERT_TRUE(tracker.Track(Picture(Truth(0)), Camera(), Sensors(0)).match.pose);
  const cv::Mat wall(240, 320, CV_8UC3, cv::Scalar(60, 70, 80));
  const SkylineFrame failed = tracker.Track(wall, Camera(), Sensors(1));
  EXPECT_FALSE(failed.match.pose);
  EXPECT_FALSE(failed.match.reason.empty());
  const SkylineFrame next = tracker.Track(Picture(Truth(2)), Camera(), Sensors(2));
  EXPECT_EQ(next.start.center_in_world, Sensors(2).center_in_world);
  EXPECT_EQ(next.method, SkylineMatch::k6dof);
  ASSERT_TRUE(next.match.pose) << next.match.reason;
  EXPECT_LT(HeadingError(next, 2), 1.5);
}

TEST_F(SkylineTracking, APositionAsBadAsTheSensorsDoesNotPassForAHeading) {
  SkylineTrackOptions options;
  options.start = "sensors";
  SkylineTracker tracker(scene_, options);
  const SkylineFrame near = tracker.Track(Picture(Truth(0)), Camera(), Sensors(0));
  EXPECT_FALSE(near.match.pose);
  EXPECT_GT(near.match.heading_sigma_deg, options.match.max_heading_sigma_deg);

  options.match.position_sigma_m = 0.1;
  SkylineTracker surveyed(scene_, options);
  Pose start = Sensors(0);
  start.center_in_world = Truth(0).center_in_world;
  const SkylineFrame known = surveyed.Track(Picture(Truth(0)), Camera(), start);
  ASSERT_TRUE(known.match.pose) << known.match.reason;
  EXPECT_LT(known.match.heading_sigma_deg, near.match.heading_sigma_deg);
  EXPECT_LT(HeadingError(known, 0), 1.0);
}

// The picture's own skyline at the true pose is off by no more than the extraction is.
TEST_F(SkylineTracking, DistancesAtTheTruthAreThoseOfTheExtraction) {
  SkylineTracker tracker(scene_, SkylineTrackOptions{});
  const SkylineFrame frame = tracker.Track(Picture(Truth(0)), Camera(), Sensors(0));
  const SkylineDistances at_truth = tracker.DistancesAt(frame.skyline, Camera(), Truth(0));
  // Two pixels of this small picture.
  EXPECT_LT(at_truth.used_px, 4.0);
  EXPECT_LT(at_truth.plain_px, 4.0);
}

}  // namespace
}  // namespace ridgeline
