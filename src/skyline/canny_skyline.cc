// SPDX-License-Identifier: Apache-2.0
#include "skyline/canny_skyline.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <opencv2/imgproc.hpp>
#include <string>
#include <vector>

#include "skyline/reduce.h"

namespace ridgeline {
namespace {

constexpr int kNoEdge = -1;

// Row of the first edge pixel of each column.
std::vector<int> UpperEnvelope(const cv::Mat& edges) {
  std::vector<int> rows(static_cast<std::size_t>(edges.cols), kNoEdge);
  int left = edges.cols;
  for (int y = 0; y < edges.rows && left > 0; ++y) {
    const std::uint8_t* e = edges.ptr(y);
    for (int x = 0; x < edges.cols; ++x) {
      int& row = rows[static_cast<std::size_t>(x)];
      if (e[x] == 0 || row != kNoEdge) continue;
      row = y;
      --left;
    }
  }
  return rows;
}

// Columns of the cheapest chain of envelope pixels from a source left of the picture to a sink
// right of it. Source and sink may be linked to any column, at the cost of the columns they bridge.
std::vector<int> ShortestPath(const std::vector<int>& rows, int max_gap, double gap_cost) {
  const int columns = static_cast<int>(rows.size());
  const double never = std::numeric_limits<double>::infinity();
  std::vector<double> cost(rows.size(), never);
  std::vector<int> previous(rows.size(), kNoEdge);
  int last = kNoEdge;
  double least = never;
  for (int x = 0; x < columns; ++x) {
    const std::size_t i = static_cast<std::size_t>(x);
    if (rows[i] == kNoEdge) continue;
    cost[i] = gap_cost * x;
    for (int p = std::max(0, x - 1 - max_gap); p < x; ++p) {
      const std::size_t k = static_cast<std::size_t>(p);
      if (rows[k] == kNoEdge) continue;
      const double through =
          cost[k] + std::hypot(x - p, rows[i] - rows[k]) + gap_cost * (x - p - 1);
      if (through >= cost[i]) continue;
      cost[i] = through;
      previous[i] = p;
    }
    const double whole = cost[i] + gap_cost * (columns - 1 - x);
    if (whole >= least) continue;
    least = whole;
    last = x;
  }
  std::vector<int> path;
  for (int x = last; x != kNoEdge; x = previous[static_cast<std::size_t>(x)]) path.push_back(x);
  std::reverse(path.begin(), path.end());
  return path;
}

}  // namespace

Skyline ExtractCannySkyline(const cv::Mat& bgr, const CannySkylineOptions& options) {
  const cv::Mat work = ReducedToWidth(bgr, options.work_width_px);
  cv::Mat grey, edges;
  cv::cvtColor(work, grey, cv::COLOR_BGR2GRAY);
  cv::Canny(grey, edges, options.low_threshold, options.high_threshold);
  const std::vector<int> rows = UpperEnvelope(edges);
  const std::vector<int> path = ShortestPath(rows, options.max_gap_px, options.gap_cost);

  Skyline skyline;
  skyline.image_width = bgr.cols;
  skyline.image_height = bgr.rows;
  skyline.column_step_px = static_cast<double>(bgr.cols) / work.cols;
  skyline.y_px.assign(rows.size(), 0.0f);
  skyline.confidence.assign(rows.size(), path.empty() ? 0.0f : 1.0f);
  skyline.columns.assign(rows.size(),
                         path.empty() ? SkylineColumn::kUnknown : SkylineColumn::kSeen);
  if (path.empty()) return skyline;
  const double row_px = static_cast<double>(bgr.rows) / work.rows;
  std::size_t next = 0;  // first node of the path at or right of the column
  for (std::size_t c = 0; c < rows.size(); ++c) {
    while (next < path.size() && path[next] < static_cast<int>(c)) ++next;
    const int right = path[std::min(next, path.size() - 1)];
    const int left = next == 0 || right == static_cast<int>(c) ? right : path[next - 1];
    const double y0 = rows[static_cast<std::size_t>(left)];
    const double y1 = rows[static_cast<std::size_t>(right)];
    const double t = left == right ? 0.0 : (static_cast<double>(c) - left) / (right - left);
    // Right of the last node the path goes on level.
    const double y = next == path.size() ? y1 : y0 + t * (y1 - y0);
    skyline.y_px[c] = static_cast<float>((y + 0.5) * row_px);
  }
  return skyline;
}

}  // namespace ridgeline
