// SPDX-License-Identifier: Apache-2.0
#include "score/foliage_mask.h"

#include <gtest/gtest.h>

#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

namespace ridgeline {
namespace {

// A grey wall with windows, 960 x 640, and what is drawn on it in kPatch.
class OnAWall : public ::testing::Test {
 protected:
  OnAWall() {
    for (int x = 20; x + 40 < wall_.cols; x += 80) {
      for (int y = 30; y + 60 < wall_.rows; y += 110) {
        cv::rectangle(wall_, cv::Rect(x, y, 40, 60), cv::Scalar(60, 55, 50), cv::FILLED);
      }
    }
  }

  // Leaves: small ellipses of a colour, from dark to bright.
  void GrowLeaves(const cv::Scalar& bgr) {
    cv::RNG random(5);
    for (int k = 0; k < 20000; ++k) {
      const cv::Point place(random.uniform(kPatch.x, kPatch.br().x),
                            random.uniform(kPatch.y, kPatch.br().y));
      cv::ellipse(wall_, place, cv::Size(4, 2), random.uniform(0.0, 180.0), 0.0, 360.0,
                  bgr * random.uniform(0.3, 1.0), cv::FILLED);
    }
  }

  // Share of the mask inside and outside of the patch.
  static double Inside(const cv::Mat& picture) {
    return cv::mean(FoliageMask(picture)(kPatch))[0] / 255.0;
  }
  static double Outside(const cv::Mat& picture) {
    cv::Mat mask = FoliageMask(picture);
    const cv::Rect grown(kPatch.tl() - cv::Point(20, 20), kPatch.size() + cv::Size(40, 40));
    mask(grown).setTo(0);
    return cv::mean(mask)[0] / 255.0;
  }

  static const cv::Rect kPatch;
  cv::Mat wall_{640, 960, CV_8UC3, cv::Scalar(150, 150, 150)};
};

const cv::Rect OnAWall::kPatch(300, 200, 300, 250);

TEST_F(OnAWall, LeavesAreFoundAndNothingElse) {
  EXPECT_EQ(Inside(wall_), 0.0);
  GrowLeaves({40, 160, 60});
  const cv::Mat mask = FoliageMask(wall_);
  EXPECT_EQ(mask.type(), CV_8U);
  EXPECT_EQ(mask.size(), wall_.size());
  EXPECT_GT(Inside(wall_), 0.85);
  EXPECT_EQ(Outside(wall_), 0.0);
}

TEST_F(OnAWall, AutumnLeavesAreFound) {
  GrowLeaves({30, 170, 220});
  EXPECT_GT(Inside(wall_), 0.85);
  EXPECT_EQ(Outside(wall_), 0.0);
}

TEST_F(OnAWall, NeitherAColouredWallNorTextureAloneIsFoliage) {
  cv::Mat green = wall_.clone();
  green(kPatch).setTo(cv::Scalar(90, 160, 110));
  EXPECT_LT(Inside(green), 0.05);  // its outline at most
  GrowLeaves({150, 150, 150});
  EXPECT_EQ(Inside(wall_), 0.0);
}

TEST_F(OnAWall, ACastOfTheWholePictureDoesNotMatter) {
  GrowLeaves({150, 150, 150});
  cv::Mat greenish;
  cv::multiply(wall_, cv::Scalar(0.9, 1.0, 0.9), greenish);
  EXPECT_EQ(Inside(greenish), 0.0);
}

TEST_F(OnAWall, TheSizeOfThePictureDoesNotMatter) {
  GrowLeaves({40, 160, 60});
  cv::Mat small;
  cv::resize(wall_, small, cv::Size(), 0.5, 0.5, cv::INTER_AREA);
  const cv::Rect patch(kPatch.tl() / 2, kPatch.size() / 2);
  EXPECT_GT(cv::mean(FoliageMask(small)(patch))[0] / 255.0, 0.85);
}

TEST(FoliageMask, TinyAndPlainPicturesHaveNone) {
  EXPECT_EQ(cv::countNonZero(FoliageMask(cv::Mat(1, 1, CV_8UC3, cv::Scalar(40, 160, 60)))), 0);
  EXPECT_EQ(cv::countNonZero(FoliageMask(cv::Mat::zeros(48, 64, CV_8UC3))), 0);
}

}  // namespace
}  // namespace ridgeline
