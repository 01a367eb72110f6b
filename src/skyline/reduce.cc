// SPDX-License-Identifier: Apache-2.0
#include "skyline/reduce.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace ridgeline {

cv::Mat ReducedToWidth(const cv::Mat& image, int width) {
  if (image.cols <= width) return image;
  const double scale = static_cast<double>(width) / image.cols;
  const int rows = std::max(4, static_cast<int>(std::lround(image.rows * scale)));
  cv::Mat reduced;
  cv::resize(image, reduced, {width, rows}, 0, 0, cv::INTER_AREA);
  return reduced;
}

}  // namespace ridgeline
