// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <vector>

namespace ridgeline {

// What is measured at every pixel of a reduced picture to tell sky from the rest.
struct SkyFeatures {
  cv::Mat luma;      // CV_8U
  cv::Mat contrast;  // CV_8U: range of luma in the 3 x 3 neighbourhood
  // Colour bin of every pixel, row-major: luma, blue - red, and green excess.
  std::vector<std::uint16_t> bins;
};

SkyFeatures MeasureSkyFeatures(const cv::Mat& bgr);

// Density of colours over the bins of SkyFeatures, smoothed over neighbouring bins; sums to 1.
using ColourHistogram = std::vector<float>;

// Histogram of the pixels whose label (CV_8U, as large as the picture) equals `label`. Without such
// pixels: all zero.
ColourHistogram ColoursOf(const SkyFeatures& features, const cv::Mat& labels, std::uint8_t label);

// Bhattacharyya coefficient, in [0, 1]; 1: the same colours.
double ColourOverlap(const ColourHistogram& a, const ColourHistogram& b);

}  // namespace ridgeline
