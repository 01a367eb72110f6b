// SPDX-License-Identifier: Apache-2.0
#include "localize/focal_search.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "score/score.h"

namespace ridgeline {
namespace {

class FocalSearch : public ::testing::Test {
 protected:
  FocalSearch()
      : picture_(cv::Mat(48, 64, CV_8UC3, cv::Scalar(9, 9, 9)),
                 PinholeCamera{64, 48, 500.0, 500.0, 32.0, 24.0},
                 {},
                 {},
                 1) {}

  // The picture agrees with one focal length: a parabola of the log ratio over its logarithm.
  Localization Run(const std::vector<FocalHypothesis>& hypotheses, double true_px) {
    return WithBestFocal(picture_, hypotheses, [&](const PictureEvidence& evidence) {
      tried_.push_back(evidence.full_camera().fx);
      EXPECT_DOUBLE_EQ(evidence.full_camera().fx, evidence.full_camera().fy);
      const double off = std::log(evidence.full_camera().fx / true_px);
      Localization result;
      result.energy = Score::EnergyOf(60.0 - 4000.0 * off * off);
      result.evaluations = 10;
      return result;
    });
  }

  PictureEvidence picture_;
  std::vector<double> tried_;
};

TEST_F(FocalSearch, AKnownCameraIsSearchedOnce) {
  const Localization found = Run({}, 700.0);
  EXPECT_THAT(tried_, ::testing::ElementsAre(500.0));
  EXPECT_FALSE(found.focal_px.has_value());
  EXPECT_TRUE(found.notes.empty());
}

TEST_F(FocalSearch, ThePictureDecidesBetweenReadings) {
  const Localization found = Run({{500.0, 1.0, "a"}, {720.0, 1.0, "b"}}, 720.0);
  ASSERT_TRUE(found.focal_px.has_value());
  EXPECT_NEAR(*found.focal_px, 720.0, 1e-9);
  EXPECT_EQ(found.evaluations, 10 * tried_.size()) << "all of them count";
  EXPECT_THAT(found.notes, ::testing::ElementsAre(::testing::HasSubstr("720 px")));
}

TEST_F(FocalSearch, AReadingIsFollowedWithinItsDoubt) {
  const Localization found = Run({{500.0, 3.0, "a"}}, 545.0);
  EXPECT_NEAR(*found.focal_px, 500.0 * std::exp(0.06), 1e-9) << "two standard deviations up";
  EXPECT_NEAR(*Run({{500.0, 3.0, "a"}}, 460.0).focal_px, 500.0 * std::exp(-0.06), 1e-9);
}

TEST_F(FocalSearch, ASmallGainDoesNotOutweighTheDoubt) {
  // One per cent too short costs 0.4 nat here.
  EXPECT_EQ(Run({{500.0, 3.0, "a"}}, 505.0).focal_px, 500.0);
}

}  // namespace
}  // namespace ridgeline
