// SPDX-License-Identifier: Apache-2.0
#include "report/chart.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

namespace ridgeline {
namespace {

int Count(const cv::Mat& picture, const cv::Rect& area, const cv::Vec3b& color) {
  int count = 0;
  for (int y = area.y; y < area.br().y; ++y) {
    for (int x = area.x; x < area.br().x; ++x) count += picture.at<cv::Vec3b>(y, x) == color;
  }
  return count;
}

TEST(Chart, GridIsBrightWhereTheValueIsLeastAndGreyWhereThereIsNone) {
  GridPicture grid;
  grid.columns = grid.rows = 2;
  grid.values = {0.0, 1.0, NAN, 0.5};  // south-west, south-east, north-west, north-east
  Drawing drawing = ChartPaper(400, 360);
  DrawGrid(grid, {0, 0, 400, 360}, drawing);
  const cv::Mat picture = drawing.Picture();
  // Square cells of 238 / 2 px from (66, 74).
  const cv::Rect north_west(66, 74, 119, 119);
  const cv::Rect south_west(66, 193, 119, 119);
  const cv::Vec3b yellow(36, 231, 253);  // the end of viridis
  EXPECT_GT(Count(picture, north_west, {205, 200, 196}), 115 * 115);
  int bright = 0;
  for (int y = south_west.y + 2; y < south_west.br().y - 2; ++y) {
    for (int x = south_west.x + 2; x < south_west.br().x - 2; ++x) {
      bright += cv::norm(cv::Vec3i(picture.at<cv::Vec3b>(y, x)) - cv::Vec3i(yellow)) < 8.0;
    }
  }
  EXPECT_EQ(bright, 115 * 115);
}

TEST(Chart, SeriesAreDrawnInTheirColourInsideTheFrame) {
  Chart chart;
  chart.series = {{"a", {200, 0, 0}, {0, 1, 2}, {0, NAN, 1}, true, true},
                  {"", {0, 0, 200}, {0, 2}, {1, 1}, true, false}};
  Drawing drawing = ChartPaper(500, 300);
  DrawChart(chart, {0, 0, 500, 300}, drawing);
  const cv::Mat picture = drawing.Picture();
  const cv::Rect frame(66, 50, 418, 202);
  EXPECT_GT(Count(picture, frame, {0, 0, 200}), 40);  // two dots, no line across the gap
  EXPECT_LT(Count(picture, frame, {0, 0, 200}), 140);
  EXPECT_GT(Count(picture, frame, {200, 0, 0}), 300);  // a line across
}

TEST(Chart, NothingToDrawIsStillAPicture) {
  Drawing drawing = ChartPaper(400, 300);
  DrawChart({}, {0, 0, 400, 300}, drawing);
  GridPicture grid;
  grid.columns = grid.rows = 1;
  grid.values = {NAN};
  DrawGrid(grid, {0, 0, 400, 300}, drawing);
  Chart flat;
  flat.series = {{"flat", {0, 0, 0}, {1.0}, {5.0}, true, true}};
  DrawChart(flat, {0, 0, 400, 300}, drawing);
  EXPECT_EQ(drawing.Picture().size(), cv::Size(400, 300));
}

// An axis of one number says nothing.
TEST(Chart, AxesHaveSeveralNumbers) {
  for (const double half : {1.0, 2.4, 2.6, 4.0, 4.9, 5.1, 7.0}) {
    Chart chart;
    chart.x = {"", -10.0 * half, 10.0 * half, {}};
    chart.series = {{"", {200, 0, 0}, {0.0}, {0.0}, false, true}};
    Drawing drawing = ChartPaper(460, 460);
    DrawChart(chart, {0, 0, 460, 460}, drawing);
    const std::string svg = drawing.Svg();
    int numbers = 0;  // those below the frame
    for (std::size_t at = svg.find("<text"); at != std::string::npos; at = svg.find("<text", at + 1)) {
      numbers += std::stod(svg.substr(svg.find(" y=\"", at) + 4)) > 420.0 ? 1 : 0;
    }
    EXPECT_GE(numbers, 3) << half;
  }
}

// A score's energies of 1e-9 to 1 lie apart on a logarithmic axis, whose numbers are powers of ten.
TEST(Chart, LogarithmicAxisSpreadsPowersOfTen) {
  Chart chart;
  chart.y.log = true;
  chart.series = {{"", {200, 0, 0}, {0, 1, 2, 3}, {1e-9, 1e-6, 1e-3, 0.0}, false, true}};
  Drawing drawing = ChartPaper(500, 300);
  DrawChart(chart, {0, 0, 500, 300}, drawing);
  const std::string svg = drawing.Svg();
  EXPECT_NE(svg.find(">1e-9<"), std::string::npos);  // every second power has a label
  EXPECT_NE(svg.find(">1e-7<"), std::string::npos);
  EXPECT_EQ(svg.find(">1e-6<"), std::string::npos);
  std::vector<double> heights;
  for (std::size_t at = svg.find("<circle"); at != std::string::npos;
       at = svg.find("<circle", at + 1)) {
    heights.push_back(std::stod(svg.substr(svg.find("cy=\"", at) + 4)));
  }
  ASSERT_EQ(heights.size(), 3u);  // 0 has no place
  EXPECT_NEAR(heights[0] - heights[1], heights[1] - heights[2], 1.5);
  EXPECT_GT(heights[0] - heights[1], 60.0);
}

// Many names take more rows rather than run out of the picture.
TEST(Chart, LegendsAreNotCut) {
  Chart chart;
  for (int i = 0; i < 9; ++i) {
    chart.series.push_back(
        {"a rather long name " + std::to_string(i), SeriesColor(i), {0, 1}, {0, 1}, true, false});
  }
  Drawing drawing = ChartPaper(420, 360);
  DrawChart(chart, {0, 0, 420, 360}, drawing);
  const std::string svg = drawing.Svg();
  for (std::size_t at = svg.find("<text x="); at != std::string::npos;
       at = svg.find("<text x=", at + 1)) {
    const double x = std::stod(svg.substr(at + 9));
    const double length = std::stod(svg.substr(svg.find("textLength=\"", at) + 12));
    EXPECT_GE(x, 0.0);
    EXPECT_LE(x + length, 420.0) << svg.substr(at, 200);
  }
}

}  // namespace
}  // namespace ridgeline
