// SPDX-License-Identifier: Apache-2.0
// Fast line detector (Lee et al., "Outdoor place recognition in urban environments using straight
// lines", ICRA 2014).
#include <algorithm>
#include <opencv2/ximgproc/fast_line_detector.hpp>

#include "lines/detector_plugin.h"

namespace ridgeline {
namespace {

std::vector<cv::Vec4f> DetectFld(const cv::Mat& gray, const LineDetectionOptions& options) {
  std::vector<cv::Vec4f> lines;
  cv::ximgproc::createFastLineDetector(std::max(2, static_cast<int>(options.min_length_px)),
                                       1.41421356f,
                                       options.canny_low,
                                       options.canny_high,
                                       3,
                                       false)
      ->detect(gray, lines);
  return lines;
}

}  // namespace

extern const DetectorPlugin kFldDetector;
constinit const DetectorPlugin kFldDetector = {
    .name = "fld", .detect = DetectFld, .reads_canny = true};

}  // namespace ridgeline
