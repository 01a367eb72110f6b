// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <opencv2/core/mat.hpp>
#include <opencv2/core/matx.hpp>
#include <vector>

#include "lines/line_detector.h"

namespace ridgeline {

// How a detector joins the table (detector_table.cc). It is documented beside its definition, with
// its source.
struct DetectorPlugin {
  const char* name;  // what LineDetectionOptions::detector calls it
  // Segments x0, y0, x1, y1 of a picture of one channel, 8 bit; whole numbers are pixel centres, as
  // in OpenCV. Directions, lengths and joints are seen to by DetectLines().
  std::vector<cv::Vec4f> (*detect)(const cv::Mat& gray, const LineDetectionOptions& options);
  bool reads_canny = false;  // LineDetectionOptions::canny_low and canny_high
};

}  // namespace ridgeline
