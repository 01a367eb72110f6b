// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <opencv2/core/mat.hpp>

#include "base/options.h"
#include "skyline/skyline.h"

namespace ridgeline {

struct CannySkylineOptions {
  // Width to which the picture is reduced [px].
  int work_width_px = 640;
  // Thresholds of Canny's detector [grey values]; the higher, the fewer clouds and wires.
  double low_threshold = 60.0;
  double high_threshold = 150.0;
  // Widest gap that a link of the graph may bridge [columns].
  int max_gap_px = 60;
  // Cost of a bridged column, against the length of the links [px].
  double gap_cost = 3.0;

  void Visit(OptionVisitor& v) {
    v.Field("work_width_px", work_width_px, AtLeast(16));
    v.Field("low_threshold", low_threshold, NotNegative());
    v.Field("high_threshold", high_threshold, AtLeast(low_threshold, "low_threshold"));
    v.Field("max_gap_px", max_gap_px, NotNegative());
    v.Field("gap_cost", gap_cost, NotNegative());
  }
};

// The skyline of Ayadi et al., section 4: edge pixels (Canny), their upper envelope (the first one
// of each column), and the shortest path through the multistage graph of the envelope's pixels, one
// stage per column, whose links may bridge gaps and so leave pixels out. Columns are all seen; a
// picture without edges has only unknown columns. bgr: CV_8UC3.
Skyline ExtractCannySkyline(const cv::Mat& bgr, const CannySkylineOptions& options);

}  // namespace ridgeline
