// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <opencv2/core/mat.hpp>
#include <optional>
#include <string>
#include <vector>

#include "report/drawing.h"

namespace ridgeline {

// Charts for files (PNG and SVG, drawing.h); the HTML report has its own.

struct ChartSeries {
  std::string name;  // in the legend; empty: not listed
  Rgb color;
  std::vector<double> x;
  std::vector<double> y;  // points with a NaN are left out, and interrupt a line
  bool line = true;
  bool points = false;
};

struct ChartAxis {
  std::string label;
  std::optional<double> lower;  // absent: as the data
  std::optional<double> upper;
  std::vector<std::string> names;  // of the values 0, 1, 2, ...; empty: numbers
  bool log = false;                // values of 0 and below are left out then
};

struct Chart {
  std::string title;
  ChartAxis x;
  ChartAxis y;
  std::vector<ChartSeries> series;
  std::optional<double> mark;  // a dotted vertical line, e.g. at the truth
  std::string mark_name;
};

// Draws a chart into a part of a drawing. Its legend takes as many rows as it needs.
void DrawChart(const Chart& chart, const cv::Rect& area, Drawing& drawing);

// Names and colours in rows of an area, as many as are needed; for panels that share them. Returns
// their height.
struct LegendEntry {
  std::string name;
  Rgb color;
};
int DrawLegend(const std::vector<LegendEntry>& entries, const cv::Rect& area, Drawing& drawing);
// The height that DrawLegend() needs in an area so wide.
int LegendHeight(const std::vector<LegendEntry>& entries, int width);

// Values over a grid of positions; the least is bright, the worst tenth shares one colour. Values
// that differ in their powers of ten are shown by those.
struct GridPicture {
  std::string title;
  std::string note;  // below the title
  std::string value_label;
  // Of the middle of the lower left cell, and between cells [m]; the labels' zero is the prior.
  double first_east_m = 0.0;
  double first_north_m = 0.0;
  double spacing_m = 1.0;
  int columns = 0;
  int rows = 0;
  std::vector<double> values;  // row-major from south to north; NaN: not admissible
  struct Mark {
    std::string name;
    double east_m = 0.0;
    double north_m = 0.0;
    int shape = 0;  // 0: circle, 1: cross, 2: square
    Rgb color;
  };
  std::vector<Mark> marks;
};
void DrawGrid(const GridPicture& grid, const cv::Rect& area, Drawing& drawing);

// Distinct colours for series, in order; they repeat after eight.
Rgb SeriesColor(std::size_t index);

// An empty drawing.
Drawing ChartPaper(int width, int height);

}  // namespace ridgeline
