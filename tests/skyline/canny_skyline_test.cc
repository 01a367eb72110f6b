// SPDX-License-Identifier: Apache-2.0
#include "skyline/canny_skyline.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace ridgeline {
namespace {

cv::Mat Roofs() {
  cv::Mat picture(240, 320, CV_8UC3, cv::Scalar(220, 220, 220));
  cv::rectangle(picture, {0, 120}, {159, 239}, {60, 60, 60}, cv::FILLED);
  cv::rectangle(picture, {160, 80}, {319, 239}, {90, 90, 90}, cv::FILLED);
  return picture;
}

TEST(ExtractCannySkyline, FollowsTheUpperEnvelope) {
  const Skyline skyline = ExtractCannySkyline(Roofs(), CannySkylineOptions{});
  for (std::size_t c = 5; c < 150; ++c) EXPECT_NEAR(skyline.y_px[c], 120.0, 1.5);
  for (std::size_t c = 170; c < 315; ++c) EXPECT_NEAR(skyline.y_px[c], 80.0, 1.5);
}

TEST(ExtractCannySkyline, BridgesAGapInTheEdges) {
  cv::Mat picture = Roofs();
  // A soft patch: no edge in these columns.
  cv::Mat patch = picture(cv::Rect(60, 60, 30, 180));
  patch.setTo(cv::Scalar(220, 220, 220));
  cv::GaussianBlur(picture(cv::Rect(55, 60, 40, 180)), picture(cv::Rect(55, 60, 40, 180)), {}, 12);
  const Skyline skyline = ExtractCannySkyline(picture, CannySkylineOptions{});
  EXPECT_EQ(std::count(skyline.columns.begin(), skyline.columns.end(), SkylineColumn::kSeen), 320);
}

TEST(ExtractCannySkyline, LeavesOutAnOutlierThatWouldMakeTheWayLonger) {
  cv::Mat picture = Roofs();
  cv::circle(picture, {80, 20}, 3, {30, 30, 30}, cv::FILLED);
  const Skyline skyline = ExtractCannySkyline(picture, CannySkylineOptions{});
  for (std::size_t c = 70; c < 90; ++c) EXPECT_NEAR(skyline.y_px[c], 120.0, 1.5);
}

TEST(ExtractCannySkyline, NoEdgesIsUnknown) {
  const cv::Mat picture(100, 100, CV_8UC3, cv::Scalar(128, 128, 128));
  const Skyline skyline = ExtractCannySkyline(picture, CannySkylineOptions{});
  EXPECT_EQ(std::count(skyline.columns.begin(), skyline.columns.end(), SkylineColumn::kUnknown),
            100);
}

}  // namespace
}  // namespace ridgeline
