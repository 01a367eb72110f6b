// SPDX-License-Identifier: Apache-2.0
#include "skyline/reduce.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace ridgeline {
namespace {

constexpr int kLargeFactor = 5;

}  // namespace

cv::Mat ReducedToWidth(const cv::Mat& image, int width) {
  if (image.cols <= width) return image;
  const double scale = static_cast<double>(width) / image.cols;
  const int rows = std::max(4, static_cast<int>(std::lround(image.rows * scale)));
  // Of very large pictures every other pixel is enough for an average.
  cv::Mat source = image;
  while (source.cols >= kLargeFactor * width) {
    cv::Mat half;
    cv::resize(source, half, {source.cols / 2, source.rows / 2}, 0, 0, cv::INTER_NEAREST);
    source = half;
  }
  cv::Mat reduced;
  cv::resize(source, reduced, {width, rows}, 0, 0, cv::INTER_AREA);
  return reduced;
}

}  // namespace ridgeline
