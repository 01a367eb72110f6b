// SPDX-License-Identifier: Apache-2.0
#include "score/sky_table.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace ridgeline {

SkyTable::SkyTable(const cv::Mat& log_odds, const SkyTableOptions& options)
    : columns_(log_odds.cols),
      rows_(log_odds.rows),
      table_(static_cast<std::size_t>(columns_) * (rows_ + 1)) {
  const int n = rows_ + 1;
  const double decay = std::exp(-1.0 / (options.deviation * columns_));
  const double near_share = 1.0 - options.obstructed_share - options.missing_share;
  const double near_norm = (1.0 - decay) / (1.0 + decay);
  std::vector<double> boundary(n);  // normalized likelihood of the boundary, sums to 1
  std::vector<double> cumulative(n + 1);
  std::vector<double> near(n);
  for (int x = 0; x < columns_; ++x) {
    double sum = 0.0;
    for (int y = 0; y < rows_; ++y) sum -= log_odds.at<float>(y, x);
    boundary[0] = sum;
    for (int y = 0; y < rows_; ++y) boundary[y + 1] = boundary[y] + 2.0 * log_odds.at<float>(y, x);
    const double best = *std::max_element(boundary.begin(), boundary.end());
    double total = 0.0;
    for (double& b : boundary) total += b = std::exp(options.pixel_weight * (b - best));
    cumulative[0] = 0.0;
    for (int y = 0; y < n; ++y) cumulative[y + 1] = cumulative[y] + (boundary[y] /= total);

    // Two-sided exponential smoothing by one pass each way.
    double state = 0.0;
    for (int y = 0; y < n; ++y) near[y] = state = state * decay + boundary[y];
    state = 0.0;
    for (int y = n - 1; y >= 0; --y) {
      near[y] += state * decay;
      state = state * decay + boundary[y];
    }
    for (int y = 0; y < n; ++y) {
      const double above = cumulative[y + 1] / (y + 1);
      const double below = (1.0 - cumulative[y]) / (n - y);
      const double likelihood = near_share * near_norm * near[y] +
                                options.obstructed_share * above + options.missing_share * below;
      table_[static_cast<std::size_t>(x) * n + y] = static_cast<float>(std::log(likelihood * n));
    }
  }
}

}  // namespace ridgeline
