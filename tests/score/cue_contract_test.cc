// SPDX-License-Identifier: Apache-2.0
// What every cue must do, whatever it compares.
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numbers>
#include <set>
#include <string>
#include <vector>

#include "base/error.h"
#include "score/cue_table.h"
#include "score/evidence_score.h"
#include "score/score_options.h"
#include "support/house_before_camera.h"

namespace ridgeline {
namespace {

using testing::kCamera;

class CueContract : public ::testing::TestWithParam<const CuePlugin*>,
                    protected testing::HouseBeforeCamera {
 protected:
  std::map<std::string, double> Weights() const {
    std::map<std::string, double> weights;
    for (const CueName& cue : GetParam()->names) weights[cue.name] = 1.0;
    return weights;
  }

  std::vector<float> Values(const EvidenceScore& score,
                            double heading_deg,
                            Score::Workspace& workspace) const {
    const Pose pose = North(heading_deg);
    const PositionView view =
        ViewFrom(scene_,
                 pose.center_in_world,
                 RangeOf(kCamera, {heading_deg, 5.0, 0.0}, {}, std::numbers::pi / 180.0),
                 score.parts());
    const auto values = score.Cues(view, pose, workspace);
    return {values.begin(), values.end()};
  }

  const ScoreOptions options_;
};

TEST_P(CueContract, StandsAloneWithItsNamesAndParts) {
  const PictureEvidence picture(Photo(), kCamera, {}, options_.evidence, 1);
  const EvidenceScore score({picture, scene_, options_.evidence.cues}, Weights());
  std::vector<std::string> names;
  for (const CueName& cue : GetParam()->names) names.emplace_back(cue.name);
  EXPECT_EQ(score.cue_names(), names);
  EXPECT_EQ(score.parts().surfaces, GetParam()->parts.surfaces);
  for (const double heading : {-30.0, 0.0, 30.0, 180.0}) {
    const std::vector<float> values = Values(score, heading, *score.NewWorkspace());
    ASSERT_EQ(values.size(), names.size());
    for (const float value : values) EXPECT_TRUE(std::isfinite(value)) << heading;
  }
}

TEST_P(CueContract, WhatWasSeenBeforeLeavesNoTrace) {
  const PictureEvidence picture(Photo(), kCamera, {}, options_.evidence, 1);
  const EvidenceScore score({picture, scene_, options_.evidence.cues}, Weights());
  const auto workspace = score.NewWorkspace();
  for (const double heading : {0.0, 20.0, 180.0, -8.0, 0.0}) {
    EXPECT_EQ(Values(score, heading, *workspace), Values(score, heading, *score.NewWorkspace()));
  }
}

TEST_P(CueContract, TogetherTheTruthIsMoreLikelyThanAwayFromIt) {
  const PictureEvidence picture(Photo(), kCamera, {}, options_.evidence, 1);
  std::map<std::string, double> weights;
  for (const CueName& cue : GetParam()->names) weights[cue.name] = cue.weight;
  const EvidenceScore score({picture, scene_, options_.evidence.cues}, weights);
  const auto sum = [&](double heading_deg) {
    double total = 0.0;
    const std::vector<float> values = Values(score, heading_deg, *score.NewWorkspace());
    for (std::size_t k = 0; k < values.size(); ++k) {
      total += GetParam()->names[k].weight * values[k];
    }
    return total;
  };
  EXPECT_GT(sum(0.0), sum(-15.0));
  EXPECT_GT(sum(0.0), sum(15.0));
}

TEST_P(CueContract, ABlankPictureIsRefusedAndHarmless) {
  const cv::Mat black = cv::Mat::zeros(kCamera.height, kCamera.width, CV_8UC3);
  const PictureEvidence picture(black, kCamera, {}, options_.evidence, 1);
  const EvidenceScore score({picture, scene_, options_.evidence.cues}, Weights());
  EXPECT_STRNE(score.unusable(), "");
  for (const float value : Values(score, 0.0, *score.NewWorkspace())) {
    EXPECT_TRUE(std::isfinite(value));
  }
}

INSTANTIATE_TEST_SUITE_P(All,
                         CueContract,
                         ::testing::ValuesIn(CueTable().begin(), CueTable().end()),
                         [](const auto& test) { return test.param->names.front().name; });

TEST(CueTable, NamesAreTheirOwn) {
  const std::vector<std::string> names = CueNames();
  EXPECT_EQ(std::set<std::string>(names.begin(), names.end()).size(), names.size());
}

TEST(CueTable, ANameThatIsTakenIsRefused) {
  const std::size_t before = CueTable().size();
  EXPECT_THROW(AddCue(*CueTable().front()), InputError);
  EXPECT_EQ(CueTable().size(), before);
}

}  // namespace
}  // namespace ridgeline
