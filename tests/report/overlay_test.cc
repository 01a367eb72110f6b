// SPDX-License-Identifier: Apache-2.0
#include "report/overlay.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <opencv2/imgcodecs.hpp>

#include "base/error.h"
#include "report/picture_file.h"

namespace ridgeline {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

Overlay OneLine(const std::string& name) {
  OverlayLayer layer;
  layer.name = name;
  layer.color = {255, 0, 0};
  layer.lines = {{{10.0f, 50.5f}, {90.0f, 50.5f}}};
  Overlay overlay;
  overlay.layers = {layer};
  return overlay;
}

TEST(Overlay, DrawsTheLineWhereItIs) {
  const cv::Mat photo(100, 100, CV_8UC3, cv::Scalar(120, 120, 120));
  OverlayDrawOptions options;
  options.legend = false;
  const cv::Mat drawn = DrawOverlay(photo, OneLine("a"), options);
  const cv::Vec3b on = drawn.at<cv::Vec3b>(50, 50);
  EXPECT_GT(on[2], 230);
  EXPECT_LT(on[0], 40);
  EXPECT_EQ(drawn.at<cv::Vec3b>(20, 50), cv::Vec3b(102, 102, 102));  // 85 % of 120
}

TEST(Overlay, ShowsOnWhiteAndOnBlack) {
  for (const int grey : {0, 255}) {
    const cv::Mat photo(100, 100, CV_8U, cv::Scalar(grey));
    OverlayDrawOptions options;
    options.legend = false;
    const cv::Mat drawn = DrawOverlay(photo, OneLine("a"), options);
    double low = 0.0;
    double high = 0.0;
    cv::minMaxLoc(drawn.col(50).reshape(1), &low, &high);
    EXPECT_GT(high - low, 150.0);
  }
}

TEST(Overlay, SvgEscapesNamesAndHasTheLine) {
  const cv::Mat photo(100, 100, CV_8UC3, cv::Scalar(120, 120, 120));
  const std::string svg = OverlaySvg(photo, OneLine("<script>\"ü\"&"), OverlayDrawOptions{});
  EXPECT_THAT(svg, HasSubstr("&lt;script&gt;&quot;ü&quot;&amp;"));
  EXPECT_THAT(svg, Not(HasSubstr("<script")));
  EXPECT_THAT(svg, HasSubstr("M10.0 50.5L90.0 50.5"));
}

TEST(Overlay, RefusesOtherExtensions) {
  const cv::Mat photo(10, 10, CV_8UC3, cv::Scalar(0, 0, 0));
  try {
    WriteOverlay(photo, OneLine("a"), OverlayDrawOptions{}, "picture.bmpx");
    FAIL();
  } catch (const InputError& e) {
    EXPECT_THAT(e.what(), HasSubstr("ends in .png or .jpg"));
  }
}

TEST(EscapeMarkup, ReplacesWhatIsNotUtf8) {
  EXPECT_EQ(EscapeMarkup("a\xff<b>'\x01"), "a?&lt;b&gt;&#39;?");
  EXPECT_EQ(EscapeMarkup("Straße €"), "Straße €");
}

}  // namespace
}  // namespace ridgeline
