// SPDX-License-Identifier: Apache-2.0
#include "report/chart.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <opencv2/imgproc.hpp>

namespace ridgeline {
namespace {

const cv::Scalar kInk(40, 36, 32);
const cv::Scalar kDim(120, 112, 104);
const cv::Scalar kGrid(228, 224, 220);
constexpr double kFont = 0.45;
constexpr int kFace = cv::FONT_HERSHEY_SIMPLEX;

cv::Scalar ColorOf(const Rgb& color) { return {double(color.b), double(color.g), double(color.r)}; }

cv::Size TextSize(const std::string& text, double scale = kFont) {
  int baseline = 0;
  return cv::getTextSize(text, kFace, scale, 1, &baseline);
}

// `anchor_x`: 0 writes to the right of the point, 0.5 about it, 1 to its left.
void Write(cv::Mat& picture,
           const std::string& text,
           cv::Point at,
           double anchor_x = 0.0,
           const cv::Scalar& color = kInk,
           double scale = kFont,
           int thickness = 1) {
  at.x -= cvRound(anchor_x * TextSize(text, scale).width);
  cv::putText(picture, text, at, kFace, scale, color, thickness, cv::LINE_AA);
}

// Text that reads upwards, its middle at `at`.
void WriteUp(cv::Mat& picture, const std::string& text, cv::Point at) {
  const cv::Size size = TextSize(text);
  cv::Mat strip(size.height + 8, size.width + 4, CV_8UC3, cv::Scalar::all(255));
  Write(strip, text, {2, size.height + 2});
  cv::rotate(strip, strip, cv::ROTATE_90_COUNTERCLOCKWISE);
  const cv::Rect place(at.x - strip.cols / 2, at.y - strip.rows / 2, strip.cols, strip.rows);
  const cv::Rect inside = place & cv::Rect(0, 0, picture.cols, picture.rows);
  cv::Mat target = picture(inside);
  const cv::Mat source = strip(cv::Rect(inside.tl() - place.tl(), inside.size()));
  cv::min(target, source, target);
}

// 1, 2 or 5 times a power of ten that gives about `count` steps.
double NiceStep(double range, int count) {
  const double raw = std::max(range, 1e-12) / count;
  const double power = std::pow(10.0, std::floor(std::log10(raw)));
  for (const double factor : {1.0, 2.0, 5.0}) {
    if (factor * power >= raw) return factor * power;
  }
  return 10.0 * power;
}

std::string NumberText(double value, double step) {
  const int digits = std::max(0, static_cast<int>(-std::floor(std::log10(step) + 1e-9)));
  char text[32];
  std::snprintf(text, sizeof text, "%.*f", digits, std::abs(value) < 1e-9 * step ? 0.0 : value);
  return text;
}

struct Range {
  double lower = 0.0;
  double upper = 1.0;
};

Range RangeOfAxis(const ChartAxis& axis,
                  const std::vector<ChartSeries>& series,
                  std::vector<double> ChartSeries::*values) {
  if (!axis.names.empty()) return {-0.3, static_cast<double>(axis.names.size()) - 0.7};
  Range range{INFINITY, -INFINITY};
  for (const ChartSeries& s : series) {
    for (const double value : s.*values) {
      if (!std::isfinite(value)) continue;
      range.lower = std::min(range.lower, value);
      range.upper = std::max(range.upper, value);
    }
  }
  if (range.lower > range.upper) range = {0.0, 1.0};
  const double pad = range.upper > range.lower ? 0.04 * (range.upper - range.lower) : 0.5;
  return {axis.lower.value_or(range.lower - pad), axis.upper.value_or(range.upper + pad)};
}

struct Tick {
  double value = 0.0;
  std::string text;
};

std::vector<Tick> TicksOf(const ChartAxis& axis, const Range& range, int count) {
  std::vector<Tick> ticks;
  for (std::size_t i = 0; i < axis.names.size(); ++i) {
    ticks.push_back({static_cast<double>(i), axis.names[i]});
  }
  if (!ticks.empty()) return ticks;
  const double step = NiceStep(range.upper - range.lower, count);
  for (double k = std::ceil(range.lower / step - 1e-9);
       k * step <= range.upper * (1 + 1e-12) + 1e-12;
       ++k) {
    ticks.push_back({k * step, NumberText(k * step, step)});
  }
  return ticks;
}

// The frame of the data and its way from values to pixels.
struct Frame {
  cv::Rect box;
  Range x;
  Range y;
  cv::Point At(double vx, double vy) const {
    return {box.x + cvRound((vx - x.lower) / (x.upper - x.lower) * box.width),
            box.y + box.height - cvRound((vy - y.lower) / (y.upper - y.lower) * box.height)};
  }
};

void DrawAxes(const Chart& chart, const Frame& frame, cv::Mat& picture) {
  const cv::Rect& box = frame.box;
  for (const Tick& tick : TicksOf(chart.x, frame.x, std::max(3, box.width / 80))) {
    const cv::Point at = frame.At(tick.value, frame.y.lower);
    cv::line(picture, at, {at.x, box.y}, kGrid, 1);
    Write(picture, tick.text, {at.x, at.y + 18}, 0.5);
  }
  for (const Tick& tick : TicksOf(chart.y, frame.y, std::max(3, box.height / 50))) {
    const cv::Point at = frame.At(frame.x.lower, tick.value);
    cv::line(picture, at, {box.x + box.width, at.y}, kGrid, 1);
    Write(picture, tick.text, {at.x - 6, at.y + 4}, 1.0);
  }
  cv::rectangle(picture, box, kDim, 1);
  Write(picture, chart.x.label, {box.x + box.width / 2, box.y + box.height + 38}, 0.5);
}

void DrawSeries(const ChartSeries& series, const Frame& frame, cv::Mat& picture) {
  cv::Mat inside = picture(frame.box);
  const cv::Scalar color = ColorOf(series.color);
  constexpr std::size_t kMany = 600;
  const int radius = series.line ? 4 : series.x.size() > kMany ? 1 : 2;
  std::optional<cv::Point> last;
  for (std::size_t i = 0; i < series.x.size(); ++i) {
    if (!std::isfinite(series.x[i]) || !std::isfinite(series.y[i])) {
      last.reset();
      continue;
    }
    const cv::Point at = frame.At(series.x[i], series.y[i]) - frame.box.tl();
    if (series.line && last) cv::line(inside, *last, at, color, 2, cv::LINE_AA);
    if (series.points) cv::circle(inside, at, radius, color, cv::FILLED, cv::LINE_AA);
    last = at;
  }
}

// From the least value to the worst tenth, which shares one colour: a few bad places would leave no
// colours to the good ones.
Range ScaleOf(std::vector<double> values) {
  std::erase_if(values, [](double value) { return !std::isfinite(value); });
  if (values.empty()) return {0.0, 1.0};
  std::sort(values.begin(), values.end());
  const Range range{values.front(), values[values.size() * 9 / 10]};
  return range.upper > range.lower ? range : Range{range.lower - 0.5, range.lower + 0.5};
}

void DrawMark(GridPicture::Mark mark, cv::Point at, cv::Mat& picture) {
  for (const bool rim : {true, false}) {
    const cv::Scalar color = rim ? cv::Scalar::all(255) : ColorOf(mark.color);
    const int width = rim ? 5 : 2;
    if (mark.shape == 0) {
      cv::circle(picture, at, 9, color, width, cv::LINE_AA);
    } else if (mark.shape == 1) {
      cv::line(picture, at + cv::Point(-8, -8), at + cv::Point(8, 8), color, width, cv::LINE_AA);
      cv::line(picture, at + cv::Point(-8, 8), at + cv::Point(8, -8), color, width, cv::LINE_AA);
    } else {
      cv::rectangle(picture, at + cv::Point(-5, -5), at + cv::Point(5, 5), color, width);
    }
  }
}

// Square cells, room for labels left and below, for the scale on the right.
Frame FrameOf(const GridPicture& grid, const cv::Rect& area) {
  const int width = area.width - 66 - 96;
  const int height = area.height - 74 - 48;
  const double cell =
      std::min(static_cast<double>(width) / grid.columns, static_cast<double>(height) / grid.rows);
  Frame frame;
  frame.box = {area.x + 66, area.y + 74, cvRound(cell * grid.columns), cvRound(cell * grid.rows)};
  const double half = 0.5 * grid.spacing_m;
  frame.x = {grid.first_east_m - half, grid.first_east_m + (grid.columns - 0.5) * grid.spacing_m};
  frame.y = {grid.first_north_m - half, grid.first_north_m + (grid.rows - 0.5) * grid.spacing_m};
  return frame;
}

void DrawCells(const GridPicture& grid, const Range& range, const cv::Rect& box, cv::Mat& picture) {
  cv::Mat shades(grid.rows, grid.columns, CV_8U);
  cv::Mat known(grid.rows, grid.columns, CV_8U);
  for (int r = 0; r < grid.rows; ++r) {
    for (int c = 0; c < grid.columns; ++c) {
      const double value = grid.values[static_cast<std::size_t>(r) * grid.columns + c];
      const bool is_known = std::isfinite(value);
      const double share =
          is_known ? std::min(1.0, (value - range.lower) / (range.upper - range.lower)) : 0.0;
      shades.at<uchar>(grid.rows - 1 - r, c) = cv::saturate_cast<uchar>(255.0 * (1.0 - share));
      known.at<uchar>(grid.rows - 1 - r, c) = is_known ? 255 : 0;
    }
  }
  cv::Mat colors;
  cv::applyColorMap(shades, colors, cv::COLORMAP_VIRIDIS);
  colors.setTo(cv::Scalar(205, 200, 196), ~known);
  cv::Mat large;
  cv::resize(colors, large, box.size(), 0.0, 0.0, cv::INTER_NEAREST);
  large.copyTo(picture(box));
}

// Axes of a map around the prior; `left`: where the area begins [px].
void DrawPlaceAxes(const Frame& frame, int left, cv::Mat& picture) {
  const ChartAxis east{"east of the prior [m]", {}, {}, {}};
  const ChartAxis north{"north of the prior [m]", {}, {}, {}};
  for (const Tick& tick : TicksOf(east, frame.x, 6)) {
    const cv::Point at = frame.At(tick.value, frame.y.lower);
    cv::line(picture, at, {at.x, at.y + 4}, kDim, 1);
    Write(picture, tick.text, {at.x, at.y + 18}, 0.5);
  }
  for (const Tick& tick : TicksOf(north, frame.y, 6)) {
    const cv::Point at = frame.At(frame.x.lower, tick.value);
    cv::line(picture, at, {at.x - 4, at.y}, kDim, 1);
    Write(picture, tick.text, {at.x - 8, at.y + 4}, 1.0);
  }
  cv::rectangle(picture, frame.box, kDim, 1);
  Write(picture, east.label, {frame.box.x + frame.box.width / 2, frame.box.br().y + 38}, 0.5);
  WriteUp(picture, north.label, {left + 12, frame.box.y + frame.box.height / 2});
}

// The scale right of a map: the least value, which is the best, on top and bright.
void DrawScale(const std::string& label,
               const Range& range,
               const cv::Rect& map,
               cv::Mat& picture) {
  const cv::Rect bar(map.br().x + 14, map.y, 14, map.height);
  cv::Mat ramp(256, 1, CV_8U);
  for (int i = 0; i < 256; ++i) ramp.at<uchar>(i) = static_cast<uchar>(255 - i);
  cv::Mat colors;
  cv::Mat large;
  cv::applyColorMap(ramp, colors, cv::COLORMAP_VIRIDIS);
  cv::resize(colors, large, bar.size(), 0.0, 0.0, cv::INTER_LINEAR);
  large.copyTo(picture(bar));
  cv::rectangle(picture, bar, kDim, 1);
  const double step = NiceStep(range.upper - range.lower, 5);
  for (double k = std::ceil(range.lower / step); k * step <= range.upper; ++k) {
    const int y =
        bar.y + cvRound((k * step - range.lower) / (range.upper - range.lower) * bar.height);
    cv::line(picture, {bar.br().x, y}, {bar.br().x + 4, y}, kDim, 1);
    Write(picture, NumberText(k * step, step), {bar.br().x + 7, y + 4});
  }
  Write(picture, "and worse", {bar.x - 4, bar.br().y + 18}, 0.0, kDim);
  WriteUp(picture, label, {bar.br().x + 58, bar.y + bar.height / 2});
}

// The marks on the map, and what they are above it.
void DrawMarks(const GridPicture& grid,
               const Frame& frame,
               const cv::Rect& area,
               cv::Mat& picture) {
  int at = area.x + 16;
  for (const GridPicture::Mark& mark : grid.marks) {
    DrawMark(mark, frame.At(mark.east_m, mark.north_m), picture);
    DrawMark(mark, {at + 8, area.y + 58}, picture);
    Write(picture, mark.name, {at + 22, area.y + 63});
    at += 22 + TextSize(mark.name).width + 22;
  }
  const bool has_gaps = std::any_of(
      grid.values.begin(), grid.values.end(), [](double value) { return !std::isfinite(value); });
  if (has_gaps) Write(picture, "grey: not admissible", {at, area.y + 63}, 0.0, kDim);
}

}  // namespace

Rgb SeriesColor(std::size_t index) {
  // Okabe and Ito's colours, told apart by people with any colour vision; yellow left out, since it
  // is hardly seen on white.
  constexpr std::array<Rgb, 8> kColors = {{{0, 114, 178},
                                           {213, 94, 0},
                                           {0, 158, 115},
                                           {204, 121, 167},
                                           {230, 159, 0},
                                           {86, 180, 233},
                                           {0, 0, 0},
                                           {130, 130, 130}}};
  return kColors[index % kColors.size()];
}

cv::Mat ChartPaper(int width, int height) {
  return cv::Mat(height, width, CV_8UC3, cv::Scalar::all(255));
}

void DrawChart(const Chart& chart, const cv::Rect& area, cv::Mat& picture) {
  Frame frame;
  const bool has_legend = std::any_of(chart.series.begin(),
                                      chart.series.end(),
                                      [](const auto& s) { return !s.name.empty(); }) ||
                          !chart.mark_name.empty();
  const int top = has_legend ? 50 : 32;
  frame.box = {area.x + 66, area.y + top, area.width - 82, area.height - top - 48};
  frame.x = RangeOfAxis(chart.x, chart.series, &ChartSeries::x);
  frame.y = RangeOfAxis(chart.y, chart.series, &ChartSeries::y);
  Write(picture, chart.title, {area.x + 8, area.y + 20}, 0.0, kInk, 0.5);
  DrawAxes(chart, frame, picture);
  WriteUp(picture, chart.y.label, {area.x + 12, frame.box.y + frame.box.height / 2});
  int at = frame.box.x;
  const auto legend = [&](const std::string& name, const cv::Scalar& color) {
    if (name.empty()) return;
    cv::rectangle(picture, cv::Rect(at, area.y + 32, 14, 8), color, cv::FILLED);
    Write(picture, name, {at + 19, area.y + 41});
    at += 19 + TextSize(name).width + 18;
  };
  if (chart.mark) {
    const cv::Point foot = frame.At(*chart.mark, frame.y.lower);
    for (int y = frame.box.y; y < foot.y; y += 8) {
      cv::line(picture, {foot.x, y}, {foot.x, std::min(y + 4, foot.y)}, kDim, 2);
    }
    legend(chart.mark_name, kDim);
  }
  for (const ChartSeries& series : chart.series) {
    DrawSeries(series, frame, picture);
    legend(series.name, ColorOf(series.color));
  }
}

void DrawLegend(const std::vector<LegendEntry>& entries, const cv::Rect& area, cv::Mat& picture) {
  cv::Point at = area.tl() + cv::Point(12, 20);
  for (const LegendEntry& entry : entries) {
    const int width = 19 + TextSize(entry.name).width + 18;
    if (at.x + width > area.br().x) at = {area.x + 12, at.y + 20};
    cv::rectangle(picture, cv::Rect(at.x, at.y - 9, 14, 8), ColorOf(entry.color), cv::FILLED);
    Write(picture, entry.name, {at.x + 19, at.y});
    at.x += width;
  }
}

void DrawGrid(const GridPicture& grid, const cv::Rect& area, cv::Mat& picture) {
  const Frame frame = FrameOf(grid, area);
  const Range range = ScaleOf(grid.values);
  DrawCells(grid, range, frame.box, picture);
  DrawPlaceAxes(frame, area.x, picture);
  DrawScale(grid.value_label, range, frame.box, picture);
  Write(picture, grid.title, {area.x + 8, area.y + 20}, 0.0, kInk, 0.5);
  Write(picture, grid.note, {area.x + 8, area.y + 40}, 0.0, kDim);
  DrawMarks(grid, frame, area, picture);
}

}  // namespace ridgeline
