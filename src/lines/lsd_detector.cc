// SPDX-License-Identifier: Apache-2.0
// Line segment detector (Grompone von Gioi et al., "LSD: a line segment detector", IPOL 2012).
#include <opencv2/imgproc.hpp>

#include "lines/detector_plugin.h"

namespace ridgeline {
namespace {

std::vector<cv::Vec4f> DetectLsd(const cv::Mat& gray, const LineDetectionOptions& /*options*/) {
  std::vector<cv::Vec4f> lines;
  cv::createLineSegmentDetector(cv::LSD_REFINE_STD)->detect(gray, lines);
  return lines;
}

}  // namespace

extern const DetectorPlugin kLsdDetector;
constinit const DetectorPlugin kLsdDetector = {.name = "lsd", .detect = DetectLsd};

}  // namespace ridgeline
