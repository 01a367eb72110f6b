// SPDX-License-Identifier: Apache-2.0
#include "skyline/skyline_extractor.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "base/error.h"
#include "synthetic_picture.h"

namespace ridgeline {
namespace {

using testing::StreetPicture;
using testing::StreetSkyline;

// Largest deviation over the columns that are seen and not beside a wall.
double LargestDeviation(const Skyline& skyline) {
  double largest = 0.0;
  for (std::size_t c = 0; c < skyline.size(); ++c) {
    const double x = skyline.XOf(c);
    const double to_wall = std::min(std::abs(x - 640.0 / 3), std::abs(x - 1280.0 / 3));
    if (to_wall < 4.0 || skyline.columns[c] != SkylineColumn::kSeen) continue;
    largest = std::max(largest, std::abs(skyline.y_px[c] - StreetSkyline(x)));
  }
  return largest;
}

double ShareOf(const Skyline& skyline, SkylineColumn column) {
  return static_cast<double>(std::count(skyline.columns.begin(), skyline.columns.end(), column)) /
         static_cast<double>(skyline.size());
}

class ExtractSkylineUnder : public ::testing::TestWithParam<cv::Scalar> {};

TEST_P(ExtractSkylineUnder, FindsRoofsToHalfAPixel) {
  const Skyline skyline = ExtractSkyline(StreetPicture(GetParam()), SkylineOptions{});
  EXPECT_GT(ShareOf(skyline, SkylineColumn::kSeen), 0.95);
  EXPECT_LE(LargestDeviation(skyline), 0.5);
}

TEST_P(ExtractSkylineUnder, WiresLampsAndBirdsDoNotCaptureIt) {
  cv::Mat picture = StreetPicture(GetParam());
  cv::line(picture, {0, 60}, {639, 85}, {40, 40, 40}, 2);
  cv::line(picture, {0, 30}, {639, 22}, {40, 40, 40}, 1);
  cv::rectangle(picture, {60, 70}, {110, 78}, {70, 70, 70}, cv::FILLED);
  cv::circle(picture, {500, 50}, 4, {20, 20, 20}, cv::FILLED);
  const Skyline skyline = ExtractSkyline(picture, SkylineOptions{});
  EXPECT_GT(ShareOf(skyline, SkylineColumn::kSeen), 0.9);
  EXPECT_LE(LargestDeviation(skyline), 0.5);
}

INSTANTIATE_TEST_SUITE_P(Skies,
                         ExtractSkylineUnder,
                         ::testing::Values(testing::kOvercast, testing::kWhite, testing::kBlue));

TEST(ExtractSkyline, CloudsAreSky) {
  cv::Mat picture = StreetPicture(testing::kBlue);
  cv::Mat clouds(picture.size(), CV_8U, cv::Scalar(0));
  cv::ellipse(clouds, {180, 42}, {110, 20}, 0, 0, 360, 255, cv::FILLED);
  cv::ellipse(clouds, {480, 40}, {90, 18}, 0, 0, 360, 255, cv::FILLED);
  cv::GaussianBlur(clouds, clouds, {}, 14);
  for (int y = 0; y < 118; ++y) {
    for (int x = 0; x < 640; ++x) {
      const double a = clouds.at<std::uint8_t>(y, x) / 255.0;
      cv::Vec3b& p = picture.at<cv::Vec3b>(y, x);
      for (int k = 0; k < 3; ++k) p[k] = cv::saturate_cast<std::uint8_t>(a * 240 + (1 - a) * p[k]);
    }
  }
  EXPECT_LE(LargestDeviation(ExtractSkyline(picture, SkylineOptions{})), 0.5);
}

// Blue is seen in one corner only; the clouds below are as grey as the walls.
TEST(ExtractSkyline, GreyCloudsBelowABlueGapAreSky) {
  cv::Mat picture = StreetPicture(testing::kBlue);
  for (int y = 0; y < 200; ++y) {
    for (int x = 0; x < 640; ++x) {
      if (y >= StreetSkyline(x)) continue;
      const double cloud = std::clamp((y + 0.25 * x - 60.0) / 60.0, 0.0, 1.0);
      const cv::Vec3d grey(176.0, 172.0, 168.0);
      cv::Vec3b& p = picture.at<cv::Vec3b>(y, x);
      for (int k = 0; k < 3; ++k) {
        p[k] = cv::saturate_cast<std::uint8_t>(cloud * grey[k] + (1.0 - cloud) * p[k]);
      }
    }
  }
  const Skyline skyline = ExtractSkyline(picture, SkylineOptions{});
  EXPECT_GT(ShareOf(skyline, SkylineColumn::kSeen), 0.9);
  EXPECT_LE(LargestDeviation(skyline), 1.0);
}

// As bright as the sky and nearly of its colour, beside it at the upper border: windows tell it.
TEST(ExtractSkyline, FacadeOfTheSkysColourHasWindows) {
  cv::Mat picture = StreetPicture(testing::kOvercast);
  cv::rectangle(picture, {426, 0}, {639, 420}, {226, 236, 222}, cv::FILLED);
  cv::line(picture, {426, 0}, {426, 420}, {150, 150, 150}, 3);
  for (int y = 20; y < 380; y += 45) {
    for (int x = 445; x < 630; x += 45) {
      cv::rectangle(picture, {x, y}, {x + 20, y + 28}, {60, 55, 50}, cv::FILLED);
    }
  }
  const Skyline skyline = ExtractSkyline(picture, SkylineOptions{});
  int wrong = 0;
  for (std::size_t c = 440; c < 640; ++c) {
    wrong += skyline.columns[c] != SkylineColumn::kUnknown && skyline.y_px[c] > 20.0f;
  }
  EXPECT_EQ(wrong, 0);
}

TEST(ExtractSkyline, WhiteFacadeAtTheUpperBorderIsNotSky) {
  cv::Mat picture = StreetPicture(testing::kWhite);
  cv::rectangle(picture, {430, 0}, {639, 420}, {222, 226, 228}, cv::FILLED);
  for (int y = 30; y < 380; y += 60) {
    for (int x = 450; x < 620; x += 50) {
      cv::rectangle(picture, {x, y}, {x + 20, y + 30}, {60, 55, 50}, cv::FILLED);
    }
  }
  const Skyline skyline = ExtractSkyline(picture, SkylineOptions{});
  for (std::size_t c = 440; c < 640; ++c) EXPECT_LE(skyline.y_px[c], 1.0f) << "column " << c;
}

TEST(ExtractSkyline, NoSkyIsAboveTheImageEverywhere) {
  const cv::Mat picture = StreetPicture(testing::kBlue)(cv::Rect(430, 165, 200, 250)).clone();
  const Skyline skyline = ExtractSkyline(picture, SkylineOptions{});
  EXPECT_EQ(ShareOf(skyline, SkylineColumn::kSeen), 0.0);
  EXPECT_GT(ShareOf(skyline, SkylineColumn::kAboveImage), 0.5);
}

TEST(ExtractSkyline, SkyAloneIsBelowTheImage) {
  const cv::Mat picture(480, 640, CV_8UC3, testing::kBlue);
  EXPECT_GT(ShareOf(ExtractSkyline(picture, SkylineOptions{}), SkylineColumn::kBelowImage), 0.9);
}

TEST(ExtractSkyline, TreesAreUnknown) {
  cv::Mat picture = StreetPicture(testing::kOvercast);
  Random random(HashText("tree"), 0);
  for (int i = 0; i < 3000; ++i) {
    const double angle = random.Uniform(0.0, 6.283), r = 70.0 * std::sqrt(random.Uniform());
    const cv::Point at(300 + static_cast<int>(r * std::cos(angle)),
                       100 + static_cast<int>(r * std::sin(angle)));
    const double light = random.Uniform(0.4, 1.4);
    cv::circle(picture, at, 2, cv::Scalar(30, 90, 50) * light, cv::FILLED);
  }
  const Skyline skyline = ExtractSkyline(picture, SkylineOptions{});
  int unknown = 0;
  for (std::size_t c = 240; c < 360; ++c) unknown += skyline.columns[c] == SkylineColumn::kUnknown;
  EXPECT_GT(unknown, 100);
  int unknown_elsewhere = 0;
  for (std::size_t c = 400; c < 640; ++c) {
    unknown_elsewhere += skyline.columns[c] == SkylineColumn::kUnknown;
  }
  EXPECT_LT(unknown_elsewhere, 12);
}

TEST(ExtractSkyline, LargePicturesKeepSubPixelRows) {
  cv::Mat large;
  cv::resize(StreetPicture(testing::kOvercast), large, {}, 3.0, 3.0, cv::INTER_NEAREST);
  const Skyline skyline = ExtractSkyline(large, SkylineOptions{});
  EXPECT_EQ(skyline.image_width, 1920);
  for (std::size_t c = 20; c < 200; ++c) EXPECT_NEAR(skyline.y_px[c], 600.0, 1.0);
}

TEST(ExtractSkyline, TinyAndOddPicturesAreSafe) {
  for (const cv::Size size :
       {cv::Size(4, 4), cv::Size(17, 300), cv::Size(700, 5), cv::Size(641, 479)}) {
    const cv::Mat picture(size, CV_8UC3, testing::kBlue);
    const Skyline skyline = ExtractSkyline(picture, SkylineOptions{});
    EXPECT_EQ(skyline.image_height, size.height);
    EXPECT_GT(skyline.size(), 0u);
  }
}

TEST(SkyLogOdds, SeparatesSkyFromWalls) {
  const cv::Mat log_odds = SkyLogOdds(StreetPicture(testing::kOvercast), SkyLikelihoodOptions{});
  ASSERT_EQ(log_odds.cols, 320);
  EXPECT_GT(cv::mean(log_odds(cv::Rect(0, 0, 320, 55)))[0], 2.0);
  EXPECT_LT(cv::mean(log_odds(cv::Rect(0, 110, 320, 130)))[0], -2.0);
}

TEST(SkylineOptions, NamesTheBadField) {
  SkylineOptions options;
  options.region_weight = -1.0;
  try {
    CheckOptions(options, "skyline");
    FAIL();
  } catch (const InputError& error) {
    EXPECT_EQ(error.field(), "skyline.region_weight");
  }
}

}  // namespace
}  // namespace ridgeline
