// SPDX-License-Identifier: Apache-2.0
#include "lines/line_detector.h"

#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>

#include "base/error.h"
#include "lines/detector_table.h"

namespace ridgeline {
namespace {

constexpr int kLeft = 60;
constexpr int kTop = 40;
constexpr int kRight = 200;
constexpr int kBottom = 160;

// A bright rectangle whose borders lie at whole image coordinates.
cv::Mat Rectangle() {
  cv::Mat picture(220, 300, CV_8UC3, cv::Scalar(60, 60, 60));
  picture(cv::Rect(kLeft, kTop, kRight - kLeft, kBottom - kTop)) = cv::Scalar(200, 200, 200);
  cv::GaussianBlur(picture, picture, cv::Size(), 0.8);
  return picture;
}

// Distance of the segment's middle from the nearest border of the rectangle.
double DistanceToBorder(const LineSegment& segment) {
  const Eigen::Vector2f m = 0.5f * (segment.a + segment.b);
  return std::min({std::abs(m.x() - kLeft),
                   std::abs(m.x() - kRight),
                   std::abs(m.y() - kTop),
                   std::abs(m.y() - kBottom)});
}

class EveryDetector : public testing::TestWithParam<std::string> {};

TEST_P(EveryDetector, FindsTheFourSidesOfARectangleInColmapsFrame) {
  LineDetectionOptions options;
  options.detector = GetParam();
  options.min_length_px = 40.0;
  const std::vector<LineSegment> segments = DetectLines(Rectangle(), options);
  ASSERT_GE(segments.size(), 4u);
  for (const LineSegment& segment : segments) {
    // Canny marks whole pixels; the others are sub-pixel.
    EXPECT_LT(DistanceToBorder(segment), 1.1);
    EXPECT_GT(segment.strength, 10.0f);
  }
}

TEST_P(EveryDetector, TheBrighterSideIsToTheRight) {
  LineDetectionOptions options;
  options.detector = GetParam();
  options.min_length_px = 40.0;
  const Eigen::Vector2f inside((kLeft + kRight) / 2.0f, (kTop + kBottom) / 2.0f);
  for (const LineSegment& segment : DetectLines(Rectangle(), options)) {
    const Eigen::Vector2f along = segment.b - segment.a;
    const Eigen::Vector2f to_inside = inside - segment.a;
    EXPECT_GT(along.x() * to_inside.y() - along.y() * to_inside.x(), 0.0f);
  }
}

TEST_P(EveryDetector, ABlackPictureHasNoLines) {
  LineDetectionOptions options;
  options.detector = GetParam();
  EXPECT_TRUE(DetectLines(cv::Mat::zeros(120, 160, CV_8UC3), options).empty());
}

INSTANTIATE_TEST_SUITE_P(Detectors,
                         EveryDetector,
                         testing::ValuesIn(DetectorNames()),
                         [](const auto& detector) { return std::string(detector.param); });

TEST(DetectLines, SixteenBitGreyAndAlphaGiveTheSameLines) {
  const cv::Mat bgr = Rectangle();
  cv::Mat gray;
  cv::cvtColor(bgr, gray, cv::COLOR_BGR2GRAY);
  cv::Mat bgra;
  cv::cvtColor(bgr, bgra, cv::COLOR_BGR2BGRA);
  cv::Mat deep;
  gray.convertTo(deep, CV_16U, 257.0);
  const std::vector<LineSegment> expected = DetectLines(bgr, {});
  for (const cv::Mat& picture : {gray, bgra, deep}) {
    const std::vector<LineSegment> segments = DetectLines(picture, {});
    ASSERT_EQ(segments.size(), expected.size());
    for (std::size_t i = 0; i < segments.size(); ++i) {
      EXPECT_TRUE(segments[i].a.isApprox(expected[i].a, 1e-4f));
    }
  }
}

TEST(MergeCollinear, JoinsOverAGapAndKeepsParallels) {
  const std::vector<LineSegment> merged = MergeCollinear(
      {{{0, 0}, {10, 0}, 2.0f}, {{14, 0.5f}, {24, 0.5f}, 4.0f}, {{0, 8}, {10, 8}, 2.0f}}, 5.0);
  ASSERT_EQ(merged.size(), 2u);
  EXPECT_TRUE(merged[0].a.isApprox(Eigen::Vector2f(0, 0)));
  EXPECT_TRUE(merged[0].b.isApprox(Eigen::Vector2f(24, 0.5f)));
  EXPECT_FLOAT_EQ(merged[0].strength, 3.0f);
}

TEST(LineDetectionOptions, BadValuesAreNamed) {
  LineDetectionOptions options;
  options.detector = "sobel";
  try {
    CheckOptions(options, "lines");
    FAIL() << "nothing thrown";
  } catch (const InputError& e) {
    std::string names;
    for (const std::string& name : DetectorNames()) names += (names.empty() ? "" : ", ") + name;
    EXPECT_EQ(e.what(), "lines.detector: got \"sobel\", expected " + names + " or file");
  }
  options = {};
  options.min_length_px = 0.0;
  EXPECT_THROW(CheckOptions(options), InputError);
}

TEST(DetectorTable, ANameThatIsTakenIsRefused) {
  const std::size_t before = DetectorTable().size();
  EXPECT_THROW(AddDetector(*DetectorTable().front()), InputError);
  EXPECT_THROW(AddDetector({.name = kLinesFromFile, .detect = nullptr}), InputError);
  EXPECT_EQ(DetectorTable().size(), before);
}

}  // namespace
}  // namespace ridgeline
