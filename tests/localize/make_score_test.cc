// SPDX-License-Identifier: Apache-2.0
#include "localize/make_score.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <opencv2/imgproc.hpp>
#include <string>

#include "localize/localizer.h"
#include "support/synthetic_city.h"

namespace ridgeline {
namespace {

const PinholeCamera kCamera{320, 240, 260.0, 260.0, 160.0, 120.0};
constexpr double kStepRad = std::numbers::pi / 180.0;

// One house before the camera, which looks north.
class ScoresOfAHouse : public ::testing::TestWithParam<const char*> {
 protected:
  ScoresOfAHouse() : model_(House()), scene_(model_, nullptr, {}) {}

  static CityModel House() {
    testing::House house;
    house.center = {0.0, 20.0};
    house.ridge_m = 9.0;
    house.heading_deg = 30.0;
    return testing::MakeCity({house});
  }

  // The house in grey before a light sky and dark ground.
  cv::Mat Photo() const {
    const Pose pose = North();
    const ViewBuffers buffers = scene_.Render(kCamera, pose);
    cv::Mat picture(kCamera.height, kCamera.width, CV_8UC3, cv::Scalar(240, 220, 200));
    picture.rowRange(kCamera.height / 2, kCamera.height).setTo(cv::Scalar(60, 70, 60));
    for (int y = 0; y < picture.rows; ++y) {
      for (int x = 0; x < picture.cols; ++x) {
        const std::uint32_t surface =
            buffers.surfaces[static_cast<std::size_t>(y) * picture.cols + x];
        if (surface == kNoSurface) continue;
        const auto shade =
            static_cast<unsigned char>(120.0f + 60.0f * model_.surfaces[surface].normal.x());
        picture.at<cv::Vec3b>(y, x) = {shade, shade, shade};
      }
    }
    return picture;
  }

  static Pose North(double heading_deg = 0.0) {
    return {CamFromWorld(ViewAngles{heading_deg, 5.0, 0.0}), {0.0, 0.0, 1.7}};
  }

  struct Answer {
    double energy = 0.0;
    std::string unusable;
  };
  Answer Of(const cv::Mat& picture, double heading_deg = 0.0) const {
    ScoreOptions options;
    options.name = GetParam();
    const cv::Mat bgr = BgrOf(picture);
    const PictureEvidence evidence(bgr, kCamera, {}, options.evidence, 1);
    const auto score = MakeScore(options, evidence, bgr, kCamera, scene_, 1.0);
    const Pose pose = North(heading_deg);
    const PositionView view =
        ViewFrom(scene_,
                 pose.center_in_world,
                 RangeOf(kCamera, {heading_deg, 5.0, 0.0}, {}, kStepRad),
                 score->parts());
    PictureEvidence::Workspace workspace;
    return {Score::EnergyOf(score->LogRatio(view, pose, workspace)), score->unusable()};
  }

  CityModel model_;
  Scene scene_;
};

TEST_P(ScoresOfAHouse, TheTruthIsBetterThanAwayFromIt) {
  const cv::Mat photo = Photo();
  const double truth = Of(photo).energy;
  EXPECT_LT(truth, 0.5);
  for (const double heading : {-8.0, 8.0}) EXPECT_GT(Of(photo, heading).energy, truth) << heading;
}

TEST_P(ScoresOfAHouse, EveryFormatGivesTheSame) {
  cv::Mat gray;
  cv::cvtColor(Photo(), gray, cv::COLOR_BGR2GRAY);
  cv::Mat colour;
  cv::cvtColor(gray, colour, cv::COLOR_GRAY2BGR);
  const double energy = Of(colour).energy;
  EXPECT_NEAR(Of(gray).energy, energy, 1e-9);
  cv::Mat alpha;
  cv::cvtColor(colour, alpha, cv::COLOR_BGR2BGRA);
  EXPECT_NEAR(Of(alpha).energy, energy, 1e-9);
  cv::Mat deep;
  colour.convertTo(deep, CV_16U, 257.0);
  EXPECT_NEAR(Of(deep).energy, energy, 1e-9);
}

TEST_P(ScoresOfAHouse, PicturesThatShowNothingHaveADefinedEnergy) {
  const cv::Mat black = cv::Mat::zeros(kCamera.height, kCamera.width, CV_8UC3);
  const cv::Mat sky(kCamera.height, kCamera.width, CV_8UC3, cv::Scalar(250, 230, 210));
  cv::Mat no_sky(kCamera.height, kCamera.width, CV_8UC3);
  cv::RNG random(3);
  random.fill(no_sky, cv::RNG::UNIFORM, 0, 120);
  for (const cv::Mat& picture : {black, sky, no_sky}) {
    const Answer answer = Of(picture);
    EXPECT_FALSE(std::isnan(answer.energy));
    EXPECT_GE(answer.energy, 0.0);
    EXPECT_LE(answer.energy, 1.0);
    if (!answer.unusable.empty()) {
      EXPECT_EQ(answer.energy, 1.0);
    }
  }
  EXPECT_EQ(Of(black).energy, 1.0);
  EXPECT_NE(Of(black).unusable, "");
  EXPECT_EQ(Of(Photo()).unusable, "");
}

// Dark bricks up to the upper border: lines and colours, no sky.
TEST_P(ScoresOfAHouse, WithoutSkyTheEnergyIsDefined) {
  cv::Mat wall(kCamera.height, kCamera.width, CV_8UC3, cv::Scalar(30, 40, 60));
  for (int y = 0; y < wall.rows; y += 12) {
    for (int x = y % 24; x < wall.cols; x += 30) {
      cv::rectangle(wall, cv::Rect(x, y, 26, 9), cv::Scalar(40 + x % 50, 60, 110), cv::FILLED);
    }
  }
  const Answer answer = Of(wall);
  EXPECT_TRUE(answer.energy >= 0.0 && answer.energy <= 1.0) << answer.energy;
  // Whether bricks are sky is the extraction's to say.
  if (std::string(GetParam()) != "skyline_l1") {
    EXPECT_EQ(answer.unusable, "");
  }
}

TEST_P(ScoresOfAHouse, APoseThatSeesNoBuildingHasEnergyOne) {
  // The horizon is a skyline too.
  if (std::string(GetParam()) == "skyline_l1") GTEST_SKIP() << "needs no building";
  EXPECT_EQ(Of(Photo(), 180.0).energy, 1.0);
}

INSTANTIATE_TEST_SUITE_P(Names,
                         ScoresOfAHouse,
                         ::testing::Values("evidence",
                                           "line_energy",
                                           "skyline_l1",
                                           "oriented_chamfer",
                                           "gradient",
                                           "unexplained"),
                         [](const auto& test) { return std::string(test.param); });

}  // namespace
}  // namespace ridgeline
