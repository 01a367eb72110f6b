// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <opencv2/core/mat.hpp>

#include "base/options.h"

namespace ridgeline {

struct SkyLikelihoodOptions {
  // The picture is reduced to at most this width before anything else [px].
  int work_width_px = 320;
  // Rounds in which the colours of sky and not-sky are learned from the last round's sky.
  int rounds = 2;
  // Log odds are limited to +- this, so that no single pixel decides.
  double max_log_odds = 4.0;

  void Visit(OptionVisitor& v) {
    v.Field("work_width_px", work_width_px, AtLeast(16));
    v.Field("rounds", rounds, NotNegative());
    v.Field("max_log_odds", max_log_odds, Positive());
  }
};

// Log odds of sky against not-sky of every pixel of the reduced picture (CV_32F; the scale is
// result.cols / bgr.cols). The colours of the sky are this picture's own: they are learned from
// what is connected to the upper border, smooth, and bright or blue, against everything else; so a
// blue, overcast or overexposed sky are one case. A picture without sky gives negative values
// nearly everywhere. bgr: CV_8UC3.
cv::Mat SkyLogOdds(const cv::Mat& bgr, const SkyLikelihoodOptions& options);

}  // namespace ridgeline
