// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <opencv2/core/mat.hpp>
#include <string>
#include <vector>

#include "base/options.h"
#include "lines/line_segment.h"

namespace ridgeline {

// LineDetectionOptions::detector where the segments are given.
inline constexpr char kLinesFromFile[] = "file";

struct LineDetectionOptions {
  // One of DetectorNames(), see detector_table.h, or "file" (the query's own segments).
  std::string detector = "lsd";
  // Shortest segment kept [px of the picture given to the detector], > 0.
  double min_length_px = 12.0;
  // Collinear segments are joined over gaps up to this [px]; 0: never.
  double max_gap_px = 0.0;
  // Thresholds of Canny for "hough" [grey values], low < high.
  double canny_low = 50.0;
  double canny_high = 150.0;

  void Visit(OptionVisitor& v);
};

// Straight segments of a picture (any channels; 8 or 16 bit), in the order of the detector.
// `options.detector` must name a detector, not "file".
std::vector<LineSegment> DetectLines(const cv::Mat& picture, const LineDetectionOptions& options);

// One channel, 8 bit: colour by luma, 16 bit scaled down, an alpha channel dropped.
cv::Mat GrayOf(const cv::Mat& picture);

// Joins segments that continue each other: directions within 2 degrees, lateral offset within 1.5
// px, gap within `max_gap_px`. Longest first, deterministic.
std::vector<LineSegment> MergeCollinear(std::vector<LineSegment> segments, double max_gap_px);

}  // namespace ridgeline
