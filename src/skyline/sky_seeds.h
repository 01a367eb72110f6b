// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <opencv2/core/mat.hpp>

#include "skyline/sky_features.h"

namespace ridgeline {

// Labels of SkySeeds (CV_8U).
inline constexpr std::uint8_t kNotSkySeed = 0;
inline constexpr std::uint8_t kSkySeed = 1;
inline constexpr std::uint8_t kMixedPixel = 2;  // beside the sky: a mixture of colours

// The parts of the picture that are sky before its colours are known: smooth regions of positive
// log odds (CV_32F) that touch the upper border. Of several, the one is taken that is likeliest sky
// (its mean log odds, no holes such as windows, not deep in the picture, large), and those that
// share its colours or are as likely, and have no windows: this keeps out bright facades that reach
// the upper border. What is reached from them in small steps is sky too: clouds.
cv::Mat SkySeeds(const cv::Mat& log_odds, const SkyFeatures& features);

}  // namespace ridgeline
