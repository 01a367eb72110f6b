// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <opencv2/core/mat.hpp>
#include <vector>

namespace ridgeline {

// How likely the boundary of each column is the outline of a tree rather than of a building, in
// [0, 1]: fine texture below it, green or yellow leaves, a ragged outline, sky shining through.
//
// @param bgr  CV_8UC3.
// @param log_odds  Of sky (CV_32F), as large as bgr.
// @param boundary  Row of the first pixel below the sky per column; 0: no sky.
std::vector<float> FoliageAlong(const cv::Mat& bgr,
                                const cv::Mat& log_odds,
                                const std::vector<int>& boundary);

}  // namespace ridgeline
