// SPDX-License-Identifier: Apache-2.0
#include "skyline/skyline_extractor.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <opencv2/imgproc.hpp>
#include <string>
#include <vector>

#include "skyline/column_path.h"
#include "skyline/foliage.h"
#include "skyline/reduce.h"

namespace ridgeline {
namespace {

// exp(-step / contrast) for the largest step over the channels, as a table over 8-bit steps.
cv::Mat SmoothnessTable(double contrast, double weight) {
  cv::Mat table(1, 256, CV_32F);
  for (int i = 0; i < 256; ++i) {
    table.at<float>(i) = static_cast<float>(weight * std::exp(-i / contrast));
  }
  return table;
}

// Largest step of a colour channel to the pixel `offset` columns/rows further (CV_8U, smaller by
// it).
cv::Mat ColourStep(const cv::Mat& bgr, int dx, int dy) {
  const cv::Rect first(0, 0, bgr.cols - dx, bgr.rows - dy);
  const cv::Rect second(dx, dy, bgr.cols - dx, bgr.rows - dy);
  cv::Mat difference;
  cv::absdiff(bgr(first), bgr(second), difference);
  cv::Mat out(difference.size(), CV_8U);
  for (int y = 0; y < out.rows; ++y) {
    const std::uint8_t* d = difference.ptr(y);
    std::uint8_t* o = out.ptr(y);
    for (int x = 0; x < out.cols; ++x, d += 3) o[x] = std::max({d[0], d[1], d[2]});
  }
  return out;
}

cv::Mat Transposed(const cv::Mat& m) {
  cv::Mat out;
  cv::transpose(m, out);
  return out;
}

// @param log_odds  CV_32F, as large as bgr.
ColumnCosts BoundaryCosts(const cv::Mat& bgr, const cv::Mat& log_odds, const SkylineOptions& o) {
  ColumnCosts costs;
  costs.columns = bgr.cols;
  costs.rows = bgr.rows;
  const double scale = 640.0 / bgr.cols;
  const cv::Mat edge_table = SmoothnessTable(o.contrast, o.edge_weight * scale);
  const cv::Mat step_table = SmoothnessTable(o.contrast, o.step_weight * scale);
  const float region = static_cast<float>(o.region_weight * scale * scale);
  const float border_cost = edge_table.at<float>(0);

  const cv::Mat odds = Transposed(log_odds);
  // Steps two rows apart: reduced pictures spread a contour over two pixels.
  const cv::Mat down = Transposed(ColourStep(bgr, 0, 2));
  const cv::Mat across = Transposed(ColourStep(bgr, 1, 0));
  costs.unary.resize(static_cast<std::size_t>(bgr.cols) * static_cast<std::size_t>(bgr.rows + 1));
  costs.step.resize(static_cast<std::size_t>(bgr.cols) * static_cast<std::size_t>(bgr.rows));
  float* unary = costs.unary.data();
  float* step = costs.step.data();
  for (int c = 0; c < bgr.cols; ++c) {
    const float* l = odds.ptr<float>(c);
    const std::uint8_t* d = down.ptr(c);
    float above = 0.0f;  // cost of calling the cells so far sky rather than not
    for (int s = 0; s <= bgr.rows; ++s) {
      float edge = 0.0f;
      if (s == 1 || s == bgr.rows - 1) edge = border_cost;
      if (s >= 2 && s <= bgr.rows - 1) edge = edge_table.at<float>(d[s - 2]);
      if (s >= 1 && s <= bgr.rows - 2) edge = std::min(border_cost, edge_table.at<float>(d[s - 1]));
      *unary++ = above + edge;
      if (s < bgr.rows) above -= region * l[s];
    }
    if (c + 1 < bgr.cols) {
      const std::uint8_t* a = across.ptr(c);
      for (int r = 0; r < bgr.rows; ++r) *step++ = step_table.at<float>(a[r]);
    }
  }
  return costs;
}

// Colour step between the rows above and below row boundary `y`, over three columns.
float StepAcross(const cv::Mat& bgr, int x, int y) {
  const std::uint8_t* above = bgr.ptr(y - 1) + 3 * (x - 1);
  const std::uint8_t* below = bgr.ptr(y) + 3 * (x - 1);
  int step[3] = {0, 0, 0};
  for (int k = 0; k < 9; ++k) step[k % 3] += below[k] - above[k];
  return static_cast<float>(std::max({std::abs(step[0]), std::abs(step[1]), std::abs(step[2])}));
}

// Moves seen rows to the strongest step of the input picture within a row of the reduced one, to a
// fraction of a pixel (parabola through three steps).
void SharpenRows(const cv::Mat& bgr, double row_px, Skyline& skyline) {
  const int reach = static_cast<int>(std::ceil(1.5 * row_px));
  std::vector<float> steps(static_cast<std::size_t>(2 * reach + 1));
  for (std::size_t c = 0; c < skyline.size(); ++c) {
    if (skyline.columns[c] != SkylineColumn::kSeen) continue;
    const int x = std::clamp(static_cast<int>(skyline.XOf(c)), 1, bgr.cols - 2);
    const int first = static_cast<int>(std::lround(skyline.y_px[c])) - reach;
    if (first < 1 || first + 2 * reach > bgr.rows - 1) continue;
    for (std::size_t i = 0; i < steps.size(); ++i) {
      steps[i] = StepAcross(bgr, x, first + static_cast<int>(i));
    }
    const auto peak = std::max_element(steps.begin(), steps.end());
    const auto k = peak - steps.begin();
    float fraction = 0.0f;
    if (k > 0 && k + 1 < static_cast<std::ptrdiff_t>(steps.size())) {
      const float curvature = peak[-1] - 2.0f * peak[0] + peak[1];
      if (curvature < 0.0f) fraction = 0.5f * (peak[-1] - peak[1]) / curvature;
    }
    skyline.y_px[c] = static_cast<float>(first + k) + fraction;
  }
}

// States this close to the best one are the same boundary, not another one.
constexpr int kSameBoundary = 3;

}  // namespace

Skyline ExtractSkyline(const cv::Mat& bgr, const SkylineOptions& options) {
  const cv::Mat work = ReducedToWidth(bgr, options.work_width_px);
  cv::Mat log_odds;
  cv::resize(SkyLogOdds(work, options.sky), log_odds, work.size(), 0, 0, cv::INTER_LINEAR);
  const ColumnPath path = CheapestColumnPath(BoundaryCosts(work, log_odds, options), kSameBoundary);
  const std::vector<float> foliage = FoliageAlong(work, log_odds, path.states);

  Skyline skyline;
  skyline.image_width = bgr.cols;
  skyline.image_height = bgr.rows;
  skyline.column_step_px = static_cast<double>(bgr.cols) / work.cols;
  const double row_px = static_cast<double>(bgr.rows) / work.rows;
  for (std::size_t c = 0; c < path.states.size(); ++c) {
    const double margin = 1.0 - std::exp(-path.margins[c] / options.margin_scale);
    const float confidence = static_cast<float>(margin) * (1.0f - foliage[c]);
    SkylineColumn column = SkylineColumn::kSeen;
    if (path.states[c] == 0) column = SkylineColumn::kAboveImage;
    if (path.states[c] == work.rows) column = SkylineColumn::kBelowImage;
    if (confidence < options.min_confidence) column = SkylineColumn::kUnknown;
    skyline.y_px.push_back(static_cast<float>(path.states[c] * row_px));
    skyline.confidence.push_back(column == SkylineColumn::kUnknown ? 0.0f : confidence);
    skyline.columns.push_back(column);
  }
  SharpenRows(bgr, row_px, skyline);
  return skyline;
}

}  // namespace ridgeline
