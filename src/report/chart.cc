// SPDX-License-Identifier: Apache-2.0
#include "report/chart.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <functional>
#include <opencv2/imgproc.hpp>

namespace ridgeline {
namespace {

constexpr Rgb kInk{32, 36, 40};
constexpr Rgb kDim{104, 112, 120};
constexpr Rgb kGrid{220, 224, 228};
constexpr Rgb kWhite{255, 255, 255};
constexpr double kFont = 0.45;
constexpr double kTitleFont = 0.5;
constexpr int kLegendRow = 20;

int WidthOf(const std::string& text) { return Drawing::TextWidth(text, kFont); }

void Write(Drawing& drawing,
           const std::string& text,
           cv::Point at,
           double anchor = 0.0,
           const Rgb& color = kInk,
           double scale = kFont) {
  drawing.Text(text, at, anchor, color, scale);
}

void WriteUp(Drawing& drawing, const std::string& text, cv::Point middle) {
  drawing.TextUp(text, middle, kInk, kFont);
}

// 1, 2 or 5 times a power of ten that gives about `count` steps, a few more rather than half as many.
double NiceStep(double range, int count) {
  const double raw = 0.8 * std::max(range, 1e-12) / count;
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
  bool log = false;

  double Share(double value) const {
    if (log) return std::log(value / lower) / std::log(upper / lower);
    return (value - lower) / (upper - lower);
  }
  bool Takes(double value) const { return std::isfinite(value) && (!log || value > 0.0); }
};

Range RangeOfAxis(const ChartAxis& axis,
                  const std::vector<ChartSeries>& series,
                  std::vector<double> ChartSeries::*values) {
  if (!axis.names.empty()) return {-0.3, static_cast<double>(axis.names.size()) - 0.7};
  Range range{INFINITY, -INFINITY, axis.log};
  for (const ChartSeries& s : series) {
    for (const double value : s.*values) {
      if (!range.Takes(value)) continue;
      range.lower = std::min(range.lower, value);
      range.upper = std::max(range.upper, value);
    }
  }
  if (range.lower > range.upper) return axis.log ? Range{0.1, 1.0, true} : Range{};
  if (axis.log) {
    const double factor = std::max(1.3, std::pow(range.upper / range.lower, 0.04));
    return {axis.lower.value_or(range.lower / factor),
            axis.upper.value_or(range.upper * factor),
            true};
  }
  const double pad = range.upper > range.lower ? 0.04 * (range.upper - range.lower) : 0.5;
  // A little below a given limit, so that no point lies on the axis.
  return {axis.lower ? *axis.lower - 0.25 * pad : range.lower - pad,
          axis.upper.value_or(range.upper + pad)};
}

struct Tick {
  double value = 0.0;
  std::string text;
};

// Powers of ten, every so many of them.
std::vector<Tick> LogTicks(const Range& range, int count) {
  const int first = static_cast<int>(std::ceil(std::log10(range.lower) - 1e-9));
  const int last = static_cast<int>(std::floor(std::log10(range.upper) + 1e-9));
  const int every = std::max(1, (last - first) / std::max(1, count) + 1);
  std::vector<Tick> ticks;
  for (int power = first; power <= last; power += every) {
    char text[32];
    std::snprintf(text, sizeof text, power >= -3 && power <= 3 ? "%g" : "1e%.0f",
                  power >= -3 && power <= 3 ? std::pow(10.0, power) : double(power));
    ticks.push_back({std::pow(10.0, power), text});
  }
  if (ticks.size() > 1) return ticks;
  for (const double value : {range.lower, range.upper}) {  // less than a decade
    char text[32];
    std::snprintf(text, sizeof text, "%.2g", value);
    ticks.push_back({value, text});
  }
  return ticks;
}

std::vector<Tick> TicksOf(const ChartAxis& axis, const Range& range, int count) {
  std::vector<Tick> ticks;
  for (std::size_t i = 0; i < axis.names.size(); ++i) {
    ticks.push_back({static_cast<double>(i), axis.names[i]});
  }
  if (!ticks.empty()) return ticks;
  if (range.log) return LogTicks(range, count);
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
    return {box.x + cvRound(x.Share(vx) * box.width),
            box.y + box.height - cvRound(y.Share(vy) * box.height)};
  }
};

void DrawAxes(const Chart& chart, const Frame& frame, Drawing& drawing) {
  const cv::Rect& box = frame.box;
  for (const Tick& tick : TicksOf(chart.x, frame.x, std::max(3, box.width / 80))) {
    const cv::Point at = frame.At(tick.value, frame.y.lower);
    drawing.Line(at, {at.x, box.y}, kGrid, 1);
    Write(drawing, tick.text, {at.x, at.y + 18}, 0.5);
  }
  for (const Tick& tick : TicksOf(chart.y, frame.y, std::max(3, box.height / 50))) {
    const cv::Point at = frame.At(frame.x.lower, tick.value);
    drawing.Line(at, {box.x + box.width, at.y}, kGrid, 1);
    Write(drawing, tick.text, {at.x - 6, at.y + 4}, 1.0);
  }
  drawing.Rectangle(box, kDim, 1);
  Write(drawing, chart.x.label, {box.x + box.width / 2, box.y + box.height + 38}, 0.5);
}

void DrawSeries(const ChartSeries& series, const Frame& frame, Drawing& drawing) {
  drawing.Clip(frame.box);
  constexpr std::size_t kMany = 600;
  const int radius = series.line ? 4 : series.x.size() > kMany ? 1 : 2;
  std::optional<cv::Point> last;
  for (std::size_t i = 0; i < series.x.size(); ++i) {
    if (!frame.x.Takes(series.x[i]) || !frame.y.Takes(series.y[i])) {
      last.reset();
      continue;
    }
    const cv::Point at = frame.At(series.x[i], series.y[i]);
    if (series.line && last) drawing.Line(*last, at, series.color, 2);
    if (series.points) drawing.Circle(at, radius, series.color, 0);
    last = at;
  }
  drawing.Unclip();
}

// Names in rows of an area; returns how many rows they take.
int LayRows(const std::vector<LegendEntry>& entries,
            const cv::Rect& area,
            const std::function<void(const LegendEntry&, cv::Point)>& put) {
  cv::Point at = area.tl();
  int rows = entries.empty() ? 0 : 1;
  for (const LegendEntry& entry : entries) {
    const int width = 19 + WidthOf(entry.name) + 18;
    if (at.x > area.x && at.x + width > area.br().x) {
      at = {area.x, at.y + kLegendRow};
      ++rows;
    }
    if (put) put(entry, at);
    at.x += width;
  }
  return rows;
}

void PutEntry(const LegendEntry& entry, cv::Point at, Drawing& drawing) {
  drawing.Rectangle(cv::Rect(at.x, at.y, 14, 8), entry.color, 0);
  Write(drawing, entry.name, {at.x + 19, at.y + 9});
}

std::vector<LegendEntry> LegendOf(const Chart& chart) {
  std::vector<LegendEntry> entries;
  if (chart.mark && !chart.mark_name.empty()) entries.push_back({chart.mark_name, kDim});
  for (const ChartSeries& series : chart.series) {
    if (!series.name.empty()) entries.push_back({series.name, series.color});
  }
  return entries;
}

// From the least value to the worst tenth, which shares one colour: a few bad places would leave no
// colours to the good ones.
Range ScaleOf(std::vector<double> values) {
  std::erase_if(values, [](double value) { return !std::isfinite(value); });
  if (values.empty()) return {0.0, 1.0};
  std::sort(values.begin(), values.end());
  // Energies of a sharp score differ in their powers of ten.
  constexpr double kManifold = 30.0;
  Range range{values.front(), values[values.size() * 9 / 10]};
  range.log = range.lower > 0.0 && range.upper > kManifold * range.lower;
  return range.upper > range.lower ? range : Range{range.lower - 0.5, range.lower + 0.5};
}

void DrawMark(const GridPicture::Mark& mark, cv::Point at, Drawing& drawing) {
  for (const bool rim : {true, false}) {
    const Rgb color = rim ? kWhite : mark.color;
    const int width = rim ? 5 : 2;
    if (mark.shape == 0) {
      drawing.Circle(at, 9, color, width);
    } else if (mark.shape == 1) {
      drawing.Line(at + cv::Point(-8, -8), at + cv::Point(8, 8), color, width);
      drawing.Line(at + cv::Point(-8, 8), at + cv::Point(8, -8), color, width);
    } else {
      drawing.Rectangle(cv::Rect(at.x - 5, at.y - 5, 11, 11), color, width);
    }
  }
}

// Colours of the values, north up; grey where there is none.
cv::Mat ShadesOf(const GridPicture& grid, const Range& range) {
  cv::Mat shades(grid.rows, grid.columns, CV_8U);
  cv::Mat known(grid.rows, grid.columns, CV_8U);
  for (int r = 0; r < grid.rows; ++r) {
    for (int c = 0; c < grid.columns; ++c) {
      const double value = grid.values[static_cast<std::size_t>(r) * grid.columns + c];
      const bool is_known = std::isfinite(value);
      const double share = is_known ? std::clamp(range.Share(value), 0.0, 1.0) : 0.0;
      shades.at<uchar>(grid.rows - 1 - r, c) = cv::saturate_cast<uchar>(255.0 * (1.0 - share));
      known.at<uchar>(grid.rows - 1 - r, c) = is_known ? 255 : 0;
    }
  }
  cv::Mat colors;
  cv::applyColorMap(shades, colors, cv::COLORMAP_VIRIDIS);
  colors.setTo(cv::Scalar(205, 200, 196), ~known);
  return colors;
}

void DrawGridAxes(const Frame& frame, const cv::Rect& area, Drawing& drawing) {
  const ChartAxis east{"east of the prior [m]", {}, {}, {}, false};
  const ChartAxis north{"north of the prior [m]", {}, {}, {}, false};
  for (const Tick& tick : TicksOf(east, frame.x, 6)) {
    const cv::Point at = frame.At(tick.value, frame.y.lower);
    drawing.Line(at, {at.x, at.y + 4}, kDim, 1);
    Write(drawing, tick.text, {at.x, at.y + 18}, 0.5);
  }
  for (const Tick& tick : TicksOf(north, frame.y, 6)) {
    const cv::Point at = frame.At(frame.x.lower, tick.value);
    drawing.Line(at, {at.x - 4, at.y}, kDim, 1);
    Write(drawing, tick.text, {at.x - 8, at.y + 4}, 1.0);
  }
  drawing.Rectangle(frame.box, kDim, 1);
  Write(drawing, east.label, {frame.box.x + frame.box.width / 2, frame.box.br().y + 38}, 0.5);
  WriteUp(drawing, north.label, {area.x + 12, frame.box.y + frame.box.height / 2});
}

// The least value, which is the best, on top and bright.
void DrawScale(const Range& range,
               const std::string& label,
               const cv::Rect& bar,
               Drawing& drawing) {
  cv::Mat ramp(256, 1, CV_8U);
  for (int i = 0; i < 256; ++i) ramp.at<uchar>(i) = static_cast<uchar>(255 - i);
  cv::Mat colors;
  cv::applyColorMap(ramp, colors, cv::COLORMAP_VIRIDIS);
  drawing.Image(colors, bar);
  drawing.Rectangle(bar, kDim, 1);
  for (const Tick& tick : TicksOf({}, range, 5)) {
    const int y = bar.y + cvRound(range.Share(tick.value) * bar.height);
    if (y < bar.y || y > bar.br().y) continue;
    drawing.Line({bar.br().x, y}, {bar.br().x + 4, y}, kDim, 1);
    Write(drawing, tick.text, {bar.br().x + 7, y + 4});
  }
  Write(drawing, "and worse", {bar.x - 4, bar.br().y + 18}, 0.0, kDim);
  WriteUp(drawing, label, {bar.br().x + 66, bar.y + bar.height / 2});
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

Drawing ChartPaper(int width, int height) { return {width, height}; }

void DrawChart(const Chart& chart, const cv::Rect& area, Drawing& drawing) {
  const std::vector<LegendEntry> legend = LegendOf(chart);
  const cv::Rect names(area.x + 66, area.y + 32, area.width - 82, 0);
  const int rows = LayRows(legend, names, {});
  const int top = rows == 0 ? 32 : 30 + kLegendRow * rows;
  Frame frame;
  frame.box = {area.x + 66, area.y + top, area.width - 82, area.height - top - 48};
  frame.x = RangeOfAxis(chart.x, chart.series, &ChartSeries::x);
  frame.y = RangeOfAxis(chart.y, chart.series, &ChartSeries::y);
  Write(drawing, chart.title, {area.x + 8, area.y + 20}, 0.0, kInk, kTitleFont);
  DrawAxes(chart, frame, drawing);
  WriteUp(drawing, chart.y.label, {area.x + 12, frame.box.y + frame.box.height / 2});
  if (chart.mark) {
    const cv::Point foot = frame.At(*chart.mark, frame.y.lower);
    for (int y = frame.box.y; y < foot.y; y += 8) {
      drawing.Line({foot.x, y}, {foot.x, std::min(y + 4, foot.y)}, kDim, 2);
    }
  }
  for (const ChartSeries& series : chart.series) DrawSeries(series, frame, drawing);
  LayRows(legend, names, [&](const LegendEntry& entry, cv::Point at) {
    PutEntry(entry, at, drawing);
  });
}

int DrawLegend(const std::vector<LegendEntry>& entries, const cv::Rect& area, Drawing& drawing) {
  const cv::Rect inside(area.x + 12, area.y + 11, area.width - 24, area.height);
  return 12 + kLegendRow * LayRows(entries, inside, [&](const LegendEntry& entry, cv::Point at) {
           PutEntry(entry, at, drawing);
         });
}

int LegendHeight(const std::vector<LegendEntry>& entries, int width) {
  return 12 + kLegendRow * LayRows(entries, {12, 0, width - 24, 0}, {});
}

void DrawGrid(const GridPicture& grid, const cv::Rect& area, Drawing& drawing) {
  // Square cells, room for labels left and below, for the scale on the right.
  const int width = area.width - 66 - 96;
  const int height = area.height - 74 - 48;
  const double cell =
      std::min(static_cast<double>(width) / grid.columns, static_cast<double>(height) / grid.rows);
  Frame frame;
  frame.box = {area.x + 66, area.y + 74, cvRound(cell * grid.columns), cvRound(cell * grid.rows)};
  const double half = 0.5 * grid.spacing_m;
  frame.x = {grid.first_east_m - half, grid.first_east_m + (grid.columns - 0.5) * grid.spacing_m};
  frame.y = {grid.first_north_m - half, grid.first_north_m + (grid.rows - 0.5) * grid.spacing_m};
  const Range range = ScaleOf(grid.values);
  drawing.Image(ShadesOf(grid, range), frame.box);
  DrawGridAxes(frame, area, drawing);
  DrawScale(range,
            grid.value_label,
            {frame.box.br().x + 14, frame.box.y, 14, frame.box.height},
            drawing);

  Write(drawing, grid.title, {area.x + 8, area.y + 20}, 0.0, kInk, kTitleFont);
  Write(drawing, grid.note, {area.x + 8, area.y + 40}, 0.0, kDim);
  int at = area.x + 16;
  for (const GridPicture::Mark& mark : grid.marks) {
    DrawMark(mark, frame.At(mark.east_m, mark.north_m), drawing);
    DrawMark(mark, {at + 8, area.y + 58}, drawing);
    Write(drawing, mark.name, {at + 22, area.y + 63});
    at += 22 + WidthOf(mark.name) + 22;
  }
  const bool has_gaps = std::any_of(
      grid.values.begin(), grid.values.end(), [](double value) { return !std::isfinite(value); });
  if (has_gaps) Write(drawing, "grey: not admissible", {at, area.y + 63}, 0.0, kDim);
}

}  // namespace ridgeline
