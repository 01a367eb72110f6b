// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <opencv2/core/mat.hpp>

namespace ridgeline {

// Where leaves hide what is behind them: CV_8U of the size of the picture (CV_8UC3), 255 or 0.
// Leaves are finely textured for their brightness, and greener or yellower than most of the picture
// (which takes a cast of the whole picture out). Bare trees and hedges without a colour are not
// found.
cv::Mat FoliageMask(const cv::Mat& bgr);

}  // namespace ridgeline
