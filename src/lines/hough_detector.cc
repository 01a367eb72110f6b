// SPDX-License-Identifier: Apache-2.0
// Canny and the probabilistic Hough transform (Matas et al. 2000): what Loeper et al. use on the
// z-buffer.
#include <opencv2/imgproc.hpp>

#include "lines/detector_plugin.h"

namespace ridgeline {
namespace {

std::vector<cv::Vec4f> DetectHough(const cv::Mat& gray, const LineDetectionOptions& options) {
  cv::Mat edges;
  cv::Canny(gray, edges, options.canny_low, options.canny_high);
  std::vector<cv::Vec4i> found;
  cv::HoughLinesP(edges, found, 1.0, CV_PI / 180.0, 30, options.min_length_px, 4.0);
  return {found.begin(), found.end()};
}

}  // namespace

extern const DetectorPlugin kHoughDetector;
constinit const DetectorPlugin kHoughDetector = {
    .name = "hough", .detect = DetectHough, .reads_canny = true};

}  // namespace ridgeline
