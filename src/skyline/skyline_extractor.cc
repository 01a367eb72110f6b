// SPDX-License-Identifier: Apache-2.0
#include "skyline/skyline_extractor.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "base/error.h"
#include "skyline/column_path.h"

namespace ridgeline {
namespace {

void RequirePositive(double value, const char* name) {
  if (!(value > 0.0)) {
    throw InputError("", std::string("skyline.") + name, std::to_string(value), "more than 0");
  }
}

// exp(-step / contrast) for the largest step over the channels, as a table over 8-bit steps.
cv::Mat SmoothnessTable(double contrast, double weight) {
  cv::Mat table(1, 256, CV_32F);
  for (int i = 0; i < 256; ++i) {
    table.at<float>(i) = static_cast<float>(weight * std::exp(-i / contrast));
  }
  return table;
}

// Largest step of a colour channel to the pixel `offset` columns/rows further (CV_8U, smaller by it).
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

}  // namespace

void SkylineOptions::Validate() const {
  if (work_width_px < 16) {
    throw InputError("", "skyline.work_width_px", std::to_string(work_width_px), "at least 16");
  }
  RequirePositive(region_weight, "region_weight");
  RequirePositive(edge_weight, "edge_weight");
  RequirePositive(step_weight, "step_weight");
  RequirePositive(contrast, "contrast");
  RequirePositive(margin_scale, "margin_scale");
  if (!(min_confidence >= 0.0 && min_confidence < 1.0)) {
    throw InputError("", "skyline.min_confidence", std::to_string(min_confidence), "[0, 1)");
  }
  sky.Validate();
}

Skyline ExtractSkyline(const cv::Mat& bgr, const SkylineOptions& options) {
  cv::Mat work = bgr;
  if (bgr.cols > options.work_width_px) {
    const double scale = static_cast<double>(options.work_width_px) / bgr.cols;
    const int rows = std::max(4, static_cast<int>(std::lround(bgr.rows * scale)));
    cv::resize(bgr, work, {options.work_width_px, rows}, 0, 0, cv::INTER_AREA);
  }
  cv::Mat log_odds;
  cv::resize(SkyLogOdds(work, options.sky), log_odds, work.size(), 0, 0, cv::INTER_LINEAR);
  const ColumnPath path = CheapestColumnPath(BoundaryCosts(work, log_odds, options), 3);

  Skyline skyline;
  skyline.image_width = bgr.cols;
  skyline.image_height = bgr.rows;
  skyline.column_step_px = static_cast<double>(bgr.cols) / work.cols;
  const double row_px = static_cast<double>(bgr.rows) / work.rows;
  for (std::size_t c = 0; c < path.states.size(); ++c) {
    const int state = path.states[c];
    const double confidence = 1.0 - std::exp(-path.margins[c] / options.margin_scale);
    skyline.y_px.push_back(static_cast<float>(state * row_px));
    skyline.confidence.push_back(static_cast<float>(confidence));
    SkylineColumn column = SkylineColumn::kSeen;
    if (state == 0) column = SkylineColumn::kAboveImage;
    if (state == work.rows) column = SkylineColumn::kBelowImage;
    if (confidence < options.min_confidence) column = SkylineColumn::kUnknown;
    skyline.columns.push_back(column);
  }
  return skyline;
}

}  // namespace ridgeline
