// SPDX-License-Identifier: Apache-2.0
// EDLines (Akinlar and Topal, "EDLines: a real-time line segment detector", 2011).
#include <opencv2/ximgproc/edge_drawing.hpp>

#include "lines/detector_plugin.h"

namespace ridgeline {
namespace {

std::vector<cv::Vec4f> DetectEdLines(const cv::Mat& gray, const LineDetectionOptions& /*options*/) {
  const auto detector = cv::ximgproc::createEdgeDrawing();
  detector->detectEdges(gray);
  std::vector<cv::Vec4f> lines;
  detector->detectLines(lines);
  return lines;
}

}  // namespace

extern const DetectorPlugin kEdLinesDetector;
constinit const DetectorPlugin kEdLinesDetector = {.name = "edlines", .detect = DetectEdLines};

}  // namespace ridgeline
