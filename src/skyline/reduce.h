// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <opencv2/core/mat.hpp>

namespace ridgeline {

// The picture at most `width` pixels wide (area average); the input itself if it is not wider.
cv::Mat ReducedToWidth(const cv::Mat& image, int width);

}  // namespace ridgeline
