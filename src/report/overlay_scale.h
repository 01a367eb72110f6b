// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <opencv2/core/types.hpp>

namespace ridgeline {

// What widths and letters of an overlay are multiplied by, so that they look alike on pictures of
// any size: 1 for a diagonal of 1000 px, and never below it.
inline double OverlayScale(const cv::Size& size) {
  return std::max(1.0, std::hypot(size.width, size.height) / 1000.0);
}

}  // namespace ridgeline
