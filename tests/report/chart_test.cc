// SPDX-License-Identifier: Apache-2.0
#include "report/chart.h"

#include <gtest/gtest.h>

#include <cmath>

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
  cv::Mat picture = ChartPaper(400, 360);
  DrawGrid(grid, {0, 0, 400, 360}, picture);
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
  cv::Mat picture = ChartPaper(500, 300);
  DrawChart(chart, {0, 0, 500, 300}, picture);
  const cv::Rect frame(66, 50, 418, 202);
  EXPECT_GT(Count(picture, frame, {0, 0, 200}), 40);  // two dots, no line across the gap
  EXPECT_LT(Count(picture, frame, {0, 0, 200}), 140);
  EXPECT_GT(Count(picture, frame, {200, 0, 0}), 300);  // a line across
}

TEST(Chart, NothingToDrawIsStillAPicture) {
  cv::Mat picture = ChartPaper(400, 300);
  DrawChart({}, {0, 0, 400, 300}, picture);
  GridPicture grid;
  grid.columns = grid.rows = 1;
  grid.values = {NAN};
  DrawGrid(grid, {0, 0, 400, 300}, picture);
  Chart flat;
  flat.series = {{"flat", {0, 0, 0}, {1.0}, {5.0}, true, true}};
  DrawChart(flat, {0, 0, 400, 300}, picture);
  EXPECT_EQ(picture.size(), cv::Size(400, 300));
}

}  // namespace
}  // namespace ridgeline
