// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <opencv2/core/mat.hpp>

#include "base/options.h"
#include "skyline/sky_likelihood.h"
#include "skyline/skyline.h"

namespace ridgeline {

struct SkylineOptions {
  // Width to which the picture is reduced for the search of the boundary [px]; one column each.
  int work_width_px = 640;
  // Weight of a pixel's log odds of sky, against the costs below (per pixel of a 640 px picture).
  double region_weight = 0.25;
  // Cost of a column whose boundary lies where the picture has no step at all.
  double edge_weight = 4.0;
  // Cost per pixel of a vertical part of the boundary where the picture has no step at all.
  double step_weight = 0.5;
  // Step between neighbouring pixels that is taken for a contour rather than noise [grey values].
  double contrast = 12.0;
  // Margin over the next best boundary at which the confidence is 1 - 1/e.
  double margin_scale = 6.0;
  // Columns of a lower confidence are unknown.
  double min_confidence = 0.3;
  SkyLikelihoodOptions sky;

  void Visit(OptionVisitor& v) {
    v.Field("work_width_px", work_width_px, AtLeast(16));
    v.Field("region_weight", region_weight, Positive());
    v.Field("edge_weight", edge_weight, Positive());
    v.Field("step_weight", step_weight, Positive());
    v.Field("contrast", contrast, Positive());
    v.Field("margin_scale", margin_scale, Positive());
    v.Field("min_confidence", min_confidence, RightOpen(0.0, 1.0));
    v.Group("sky", [&](OptionVisitor& g) { sky.Visit(g); });
  }
};

// The skyline as the cheapest boundary that crosses every column once: sky-likeness of the pixels
// above against those below, and a step of colour across it (dynamic programming, exact). Wires,
// lamps and clouds do not capture it, since the sky below them would count as something else.
// Columns carry the margin over the next best boundary as a confidence; foliage lowers it.
// bgr: CV_8UC3.
Skyline ExtractSkyline(const cv::Mat& bgr, const SkylineOptions& options);

}  // namespace ridgeline
