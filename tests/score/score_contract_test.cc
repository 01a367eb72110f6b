// SPDX-License-Identifier: Apache-2.0
// What every score must do, whatever it compares.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <opencv2/imgproc.hpp>
#include <string>
#include <vector>

#include "base/error.h"
#include "localize/localizer.h"
#include "score/score_table.h"
#include "support/house_before_camera.h"

namespace ridgeline {
namespace {

using testing::kCamera;

constexpr double kStepRad = std::numbers::pi / 180.0;

class ScoreContract : public ::testing::TestWithParam<std::string>,
                      protected testing::HouseBeforeCamera {
 protected:
  struct Answer {
    double energy = 0.0;
    std::string unusable;
  };
  Answer Of(const cv::Mat& picture, double heading_deg = 0.0) const {
    ScoreOptions options;
    options.name = GetParam();
    const PictureEvidence evidence(BgrOf(picture), kCamera, {}, options.evidence, 1);
    const auto score = MakeScore({evidence, scene_, options});
    const Pose pose = North(heading_deg);
    const PositionView view = ViewOf(*score, heading_deg);
    const auto workspace = score->NewWorkspace();
    return {Score::EnergyOf(score->LogRatio(view, pose, *workspace)), score->unusable()};
  }

  PositionView ViewOf(const Score& score, double heading_deg, double half_range_deg = 0.0) const {
    return ViewFrom(scene_,
                    North().center_in_world,
                    RangeOf(kCamera, {heading_deg, 5.0, 0.0}, {half_range_deg, 0.0, 0.0}, kStepRad),
                    score.parts());
  }
};

TEST_P(ScoreContract, TheTruthIsBetterThanAwayFromIt) {
  const cv::Mat photo = Photo();
  const double truth = Of(photo).energy;
  EXPECT_LT(truth, 0.5);
  for (const double heading : {-8.0, 8.0}) EXPECT_GT(Of(photo, heading).energy, truth) << heading;
}

TEST_P(ScoreContract, EveryFormatGivesTheSame) {
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

TEST_P(ScoreContract, PicturesThatShowNothingHaveADefinedEnergy) {
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
TEST_P(ScoreContract, WithoutSkyTheEnergyIsDefined) {
  cv::Mat wall(kCamera.height, kCamera.width, CV_8UC3, cv::Scalar(30, 40, 60));
  for (int y = 0; y < wall.rows; y += 12) {
    for (int x = y % 24; x < wall.cols; x += 30) {
      cv::rectangle(wall, cv::Rect(x, y, 26, 9), cv::Scalar(40 + x % 50, 60, 110), cv::FILLED);
    }
  }
  const Answer answer = Of(wall);
  EXPECT_TRUE(answer.energy >= 0.0 && answer.energy <= 1.0) << answer.energy;
  // Whether bricks are sky is the extraction's to say.
  if (GetParam() != "skyline_l1") {
    EXPECT_EQ(answer.unusable, "");
  }
}

TEST_P(ScoreContract, APoseThatSeesNoBuildingHasEnergyOne) {
  // The horizon is a skyline too.
  if (GetParam() == "skyline_l1") GTEST_SKIP() << "needs no building";
  EXPECT_EQ(Of(Photo(), 180.0).energy, 1.0);
}

TEST_P(ScoreContract, ManyOrientationsAreAsOneAtATimeInAnyMemory) {
  ScoreOptions options;
  options.name = GetParam();
  const PictureEvidence evidence(Photo(), kCamera, {}, options.evidence, 1);
  const auto score = MakeScore({evidence, scene_, options});
  const PositionView view = ViewOf(*score, 0.0, 8.0);
  std::vector<Pose> poses;
  for (const double heading : {-8.0, 0.0, 3.0, 8.0}) poses.push_back(North(heading));
  std::vector<double> together(poses.size());
  score->LogRatios(view, poses, *score->NewWorkspace(), together);
  for (std::size_t i = 0; i < poses.size(); ++i) {
    EXPECT_EQ(together[i], score->LogRatio(view, poses[i], *score->NewWorkspace())) << i;
  }
}

TEST_P(ScoreContract, AWiderToleranceIsAnotherScoreOrNone) {
  ScoreOptions options;
  options.name = GetParam();
  const PictureEvidence evidence(Photo(), kCamera, {}, options.evidence, 1);
  auto score = MakeScore({evidence, scene_, options});
  const auto same = score->Tolerant(1.0);
  if (!same) return;
  const auto wide = score->Tolerant(3.0);
  const PositionView view = ViewOf(*score, 0.0);
  const double log_ratio = score->LogRatio(view, North(), *score->NewWorkspace());
  score.reset();  // they stand alone
  EXPECT_EQ(same->LogRatio(view, North(), *same->NewWorkspace()), log_ratio);
  EXPECT_NE(wide->LogRatio(view, North(), *wide->NewWorkspace()), log_ratio);
}

INSTANTIATE_TEST_SUITE_P(All,
                         ScoreContract,
                         ::testing::ValuesIn(ScoreNames()),
                         [](const auto& test) { return test.param; });

TEST(ScoreTable, AnUnknownNameIsRefused) {
  try {
    FindScore("evidense");
    FAIL();
  } catch (const InputError& error) {
    std::string names;
    for (const std::string& name : ScoreNames()) names += (names.empty() ? "" : ", ") + name;
    EXPECT_EQ(error.what(), "score.name: got \"evidense\", expected one of " + names);
  }
}

TEST(ScoreTable, ANameThatIsTakenIsRefused) {
  const std::size_t before = ScoreTable().size();
  EXPECT_THROW(AddScore(*ScoreTable().front()), InputError);
  EXPECT_EQ(ScoreTable().size(), before);
}

TEST(ScoreOptions, WeightsHaveNames) {
  ScoreOptions options;
  const auto visit = [&](OptionVisitor& v) {
    v.Group("score", [&](OptionVisitor& g) { options.Visit(g); });
  };
  SetOption("score.weights.sky=2.5", visit);
  EXPECT_EQ(options.weights.at("sky"), 2.5);
  EXPECT_EQ(options.weights.at("folds"), ScoreOptions().weights.at("folds"));
  const auto refusal = [&](const std::string& assignment) -> std::string {
    try {
      SetOption(assignment, visit);
      CheckOptions(options, "score");
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(refusal("score.weights.skyy=1"),
            "--set: score.weights.skyy: got an unknown key, expected e.g. \"score.weights.sky\"");
  EXPECT_EQ(refusal("score.weights=[1,2]"),
            "--set: score.weights: got [1,2], expected an object { \"skyline_edges\": ..., ... }");
  EXPECT_EQ(refusal("score.weights.sky=-1"), "score.weights.sky: got -1, expected >= 0");
}

}  // namespace
}  // namespace ridgeline
