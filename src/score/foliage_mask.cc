// SPDX-License-Identifier: Apache-2.0
#include "score/foliage_mask.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <opencv2/imgproc.hpp>
#include <vector>

namespace ridgeline {
namespace {

// Window over which a pixel's signs are averaged [share of the longer side].
constexpr double kWindowShare = 0.009;
// Of a pixel's foliage, in [0, 1].
constexpr float kThreshold = 0.4f;
// Grey values added to the brightness that signs are relative to: dark pixels are noise.
constexpr float kDark = 20.0f;

enum Sign { kTexture, kGreen, kYellow, kLevel };
using Signs = cv::Vec4f;

float Ramp(float value, float zero, float one) {
  return std::clamp((value - zero) / (one - zero), 0.0f, 1.0f);
}

// Means over blocks of two by two pixels (single ones where a side is odd).
cv::Mat SignsOf(const cv::Mat& bgr) {
  cv::Mat signs((bgr.rows + 1) / 2, (bgr.cols + 1) / 2, CV_32FC4);
  for (int j = 0; j < signs.rows; ++j) {
    Signs* out = signs.ptr<Signs>(j);
    for (int i = 0; i < signs.cols; ++i) {
      int texture = 0;
      int greens = 0;
      int yellows = 0;
      int levels = 0;
      for (int k = 0; k < 4; ++k) {
        const int y = std::min(2 * j + k / 2, bgr.rows - 1);
        const int x = std::min(2 * i + k % 2, bgr.cols - 1);
        const cv::Vec3b* row = bgr.ptr<cv::Vec3b>(y);
        const auto [b, g, r] = row[x].val;
        texture += std::abs(g - row[std::max(x - 1, 0)][1]) +
                   std::abs(g - bgr.ptr<cv::Vec3b>(std::max(y - 1, 0))[x][1]);
        greens += g - std::max(b, r);
        yellows += std::min(g, r) - b;
        levels += g;
      }
      out[i] = {0.125f * static_cast<float>(texture),
                0.25f * static_cast<float>(greens),
                0.25f * static_cast<float>(yellows),
                0.25f * static_cast<float>(levels)};
    }
  }
  return signs;
}

// Median of every second value of every second row, at least 0.
float TypicalTint(const cv::Mat& signs, Sign tint) {
  std::vector<float> values;
  for (int y = 0; y < signs.rows; y += 2) {
    const Signs* row = signs.ptr<Signs>(y);
    for (int x = 0; x < signs.cols; x += 2) values.push_back(row[x][tint]);
  }
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return std::max(0.0f, *middle);
}

}  // namespace

cv::Mat FoliageMask(const cv::Mat& bgr) {
  const int window =
      static_cast<int>(std::lround(0.5 * kWindowShare * std::max(bgr.cols, bgr.rows))) | 1;
  cv::Mat signs = SignsOf(bgr);
  cv::blur(signs, signs, cv::Size(window, window));
  signs.forEach<Signs>([](Signs& s, const int*) { s *= 1.0f / (s[kLevel] + kDark); });
  const float green = TypicalTint(signs, kGreen);
  const float yellow = TypicalTint(signs, kYellow);

  cv::Mat foliage(signs.size(), CV_32F);
  foliage.forEach<float>([&](float& f, const int* at) {
    const Signs& s = signs.at<Signs>(at[0], at[1]);
    f = Ramp(s[kTexture], 0.05f, 0.12f) *
        std::max(Ramp(s[kGreen] - green, 0.02f, 0.06f), Ramp(s[kYellow] - yellow, 0.2f, 0.35f));
  });
  cv::blur(foliage, foliage, cv::Size(window, window));
  const cv::Mat small = foliage > kThreshold;
  cv::Mat mask;
  cv::resize(small, mask, bgr.size(), 0.0, 0.0, cv::INTER_NEAREST);
  return mask;
}

}  // namespace ridgeline
