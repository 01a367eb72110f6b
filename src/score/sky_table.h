// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <opencv2/core/mat.hpp>
#include <vector>

#include "base/options.h"

namespace ridgeline {

struct SkyTableOptions {
  // Weight of one pixel's log odds (of the reduced picture): neighbours are correlated.
  double pixel_weight = 0.15;
  // Scale of the deviation between the real and the model's skyline [share of the picture's width],
  // two-sided exponential.
  double deviation = 0.012;
  // Share of columns whose real skyline lies anywhere above (trees, unmodelled parts) or anywhere
  // below the model's.
  double obstructed_share = 0.25;
  double missing_share = 0.03;

  void Visit(OptionVisitor& v) {
    v.Field("pixel_weight", pixel_weight, Closed(0.0, 10.0));
    v.Field("deviation", deviation, Closed(1e-4, 1.0));
    v.Field("obstructed_share", obstructed_share, Closed(0.0, 0.9));
    v.Field("missing_share", missing_share, Closed(0.001, 0.09));
  }
};

// For each column of a picture and each height of the model's skyline in it, the log likelihood
// ratio of the column's pixels against a skyline at an unknown height. The real boundary b has the
// likelihood exp(weight * (sum of log odds above b - sum below b)); given the model's skyline y, b is
// near y, above it where something hides the roof, or seldom below it.
class SkyTable {
 public:
  // log_odds: sky against not-sky, CV_32F, of the picture reduced by any scale.
  SkyTable(const cv::Mat& log_odds, const SkyTableOptions& options);

  int columns() const { return columns_; }
  int rows() const { return rows_; }

  // y [rows of the table], clamped to the picture; linear between rows.
  float LogRatio(int column, float y) const {
    const float clamped = y < 0.0f ? 0.0f : (y > static_cast<float>(rows_) ? rows_ : y);
    const int row = clamped >= static_cast<float>(rows_) ? rows_ - 1 : static_cast<int>(clamped);
    const float* values = &table_[static_cast<std::size_t>(column) * (rows_ + 1) + row];
    const float t = clamped - static_cast<float>(row);
    return values[0] + t * (values[1] - values[0]);
  }

 private:
  int columns_ = 0;
  int rows_ = 0;
  std::vector<float> table_;  // column-major: rows_ + 1 heights per column
};

}  // namespace ridgeline
