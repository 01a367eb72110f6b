// SPDX-License-Identifier: Apache-2.0
#include "track/track_smoother.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "base/random.h"
#include "track/nmea.h"

namespace ridgeline {
namespace {

const Eigen::Vector3d kOrigin(690000.0, 5335000.0, 500.0);

// A straight drive whose odometry is 3 % short, with a look at each frame that errs by 0.3 m; the
// looks at `lies` are 6 m off.
std::vector<TrackFrame> Drive(const std::vector<int>& lies, std::vector<Pose>& truth) {
  Random random(7, 1);
  std::vector<TrackFrame> frames;
  for (int i = 0; i < 20; ++i) {
    PoseVector v;
    v << 5.0, 3.0 * i, 2.0, 359.0 + 0.1 * i, 1.0, 0.5;
    v(3) = WrapHeadingDeg(v(3));
    truth.push_back(PoseOf(v));
    TrackFrame frame;
    if (i > 0) {
      frame.motion = MotionBetween(truth[truth.size() - 2], truth.back());
      frame.motion->step_in_before *= 0.97;
      frame.motion->sigma_m = 0.1;
      frame.motion->sigma_deg = 0.2;
    }
    PoseBell bell;
    bell.mean = v;
    for (int k = 0; k < 3; ++k) bell.mean(k) += 0.3 * random.Normal();
    if (std::count(lies.begin(), lies.end(), i) > 0) bell.mean(0) += 6.0;
    PoseVector sigmas;
    sigmas << 0.3, 0.3, 0.3, 0.3, 0.3, 0.3;
    bell.covariance = sigmas.cwiseAbs2().asDiagonal();
    bell.mass = 1.0;
    frame.evidence.push_back(bell);
    Pose causal = PoseOf(bell.mean);
    causal.center_in_world += kOrigin;
    frame.pose = causal;
    frame.state = i < 3 ? TrackState::kRelocalizing : TrackState::kTracking;
    frames.push_back(frame);
  }
  return frames;
}

double RmsOf(const std::vector<std::optional<SmoothedPose>>& poses, const std::vector<Pose>& truth) {
  double sum = 0.0;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    EXPECT_TRUE(poses[i]) << i;
    if (poses[i]) {
      sum += (poses[i]->pose.center_in_world - kOrigin - truth[i].center_in_world).squaredNorm();
    }
  }
  return std::sqrt(sum / static_cast<double>(truth.size()));
}

TEST(Smoother, AveragesTheLooksAlongTheWay) {
  std::vector<Pose> truth;
  const std::vector<TrackFrame> frames = Drive({}, truth);
  const auto smoothed = Smooth(frames, kOrigin, SmootherOptions{});
  EXPECT_LT(RmsOf(smoothed, truth), 0.4);  // the looks alone: 0.3 in each of three axes, 0.52
  // Frames before the track was found are smoothed from behind.
  ASSERT_TRUE(smoothed[0]);
  EXPECT_LT((smoothed[0]->pose.center_in_world - kOrigin - truth[0].center_in_world).norm(), 0.8);
  const double sigma = std::sqrt(smoothed[10]->covariance(0, 0));
  EXPECT_GT(sigma, 0.1);
  EXPECT_LT(sigma, 0.45);
}

TEST(Smoother, LooksThatLieAreOutvoted) {
  std::vector<Pose> truth;
  const std::vector<TrackFrame> frames = Drive({8, 14}, truth);
  EXPECT_LT(RmsOf(Smooth(frames, kOrigin, SmootherOptions{}), truth), 0.5);
}

TEST(Smoother, HasNothingWhereNothingWasTracked) {
  std::vector<Pose> truth;
  std::vector<TrackFrame> frames = Drive({}, truth);
  for (TrackFrame& frame : frames) frame.state = TrackState::kRelocalizing;
  for (const auto& pose : Smooth(frames, kOrigin, SmootherOptions{})) EXPECT_FALSE(pose);
}

TEST(Nmea, SentencesAreAsAReceiverSendsThem) {
  NmeaFix fix;
  fix.time_s = 12 * 3600 + 34 * 60 + 56.78;
  fix.latitude_deg = 48.1173;
  fix.longitude_deg = -11.516666;
  fix.altitude_m = 545.4;
  fix.true_heading_deg = 274.07;
  fix.speed_m_s = 11.5235;
  fix.course_deg = 84.4;
  fix.is_tracked = true;
  const std::string text = NmeaSentences(fix);
  EXPECT_NE(text.find("$GPGGA,123456.78,4807.038000,N,01130.999960,W,1,00,,545.40,M,,M,,*"),
            std::string::npos)
      << text;
  EXPECT_NE(text.find("$GPRMC,123456.78,A,4807.038000,N,01130.999960,W,22.40,84.40,,,,A*"),
            std::string::npos)
      << text;
  // The checksum of a sentence from the standard's own example.
  EXPECT_EQ(NmeaSentence("GPHDT,274.07,T"), "$GPHDT,274.07,T*03\r\n");
  EXPECT_NE(text.find("$GPHDT,274.07,T*03\r\n"), std::string::npos);
  EXPECT_NE(NmeaSentences(std::nullopt).find("$GPRMC,,V,"), std::string::npos);
}

}  // namespace
}  // namespace ridgeline
