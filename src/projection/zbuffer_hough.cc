// SPDX-License-Identifier: Apache-2.0
#include "projection/zbuffer_hough.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <opencv2/imgproc.hpp>
#include <string>

#include "projection/rasterizer.h"

namespace ridgeline {
namespace {

cv::Mat GrayFromDepth(const cv::Mat& depth, double white_m) {
  cv::Mat gray(depth.size(), CV_8U);
  const auto scale = static_cast<float>(254.0 / white_m);
  for (int row = 0; row < depth.rows; ++row) {
    const float* const from = depth.ptr<float>(row);
    std::uint8_t* const to = gray.ptr<std::uint8_t>(row);
    for (int column = 0; column < depth.cols; ++column) {
      const bool is_sky = std::isinf(from[column]);
      to[column] = is_sky ? 255 : static_cast<std::uint8_t>(std::min(254.0f, from[column] * scale));
    }
  }
  return gray;
}

// The segment lies on the nearer side of its edge or beside it.
float NearestDepthAround(const cv::Mat& depth, const cv::Point2f& point) {
  const cv::Rect around(static_cast<int>(point.x) - 1, static_cast<int>(point.y) - 1, 3, 3);
  double nearest = 0.0;
  cv::minMaxLoc(depth(around & cv::Rect(0, 0, depth.cols, depth.rows)), &nearest);
  return static_cast<float>(nearest);
}

}  // namespace

std::vector<ProjectedSegment> ZbufferHoughSegments(const CityModel& model,
                                                   const PinholeCamera& camera,
                                                   const Pose& cam_from_local,
                                                   const ZbufferHoughOptions& options) {
  const cv::Mat depth = RasterizeDepth(model, camera, cam_from_local, options.radius_m);
  cv::Mat edges;
  cv::Canny(GrayFromDepth(depth, options.white_m), edges, options.canny_low, options.canny_high);
  std::vector<cv::Vec4i> lines;
  cv::HoughLinesP(edges,
                  lines,
                  options.rho_px,
                  options.theta_deg * std::numbers::pi / 180.0,
                  options.votes,
                  options.min_length_px,
                  options.max_gap_px);
  std::vector<ProjectedSegment> segments;
  segments.reserve(lines.size());
  for (const cv::Vec4i& line : lines) {
    // OpenCV's pixel (0, 0) has its centre at (0.5, 0.5).
    ProjectedSegment segment;
    segment.a =
        Eigen::Vector2f(static_cast<float>(line[0]), static_cast<float>(line[1])).array() + 0.5f;
    segment.b =
        Eigen::Vector2f(static_cast<float>(line[2]), static_cast<float>(line[3])).array() + 0.5f;
    segment.piece = kNoPiece;
    const Eigen::Vector2f middle = 0.5f * (segment.a + segment.b);
    segment.depth = NearestDepthAround(depth, {middle.x(), middle.y()});
    segments.push_back(segment);
  }
  return segments;
}

}  // namespace ridgeline
