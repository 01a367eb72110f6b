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

cv::Mat SignsOf(const cv::Mat& bgr) {
  cv::Mat signs(bgr.size(), CV_32FC4);
  for (int y = 0; y < bgr.rows; ++y) {
    const cv::Vec3b* row = bgr.ptr<cv::Vec3b>(y);
    const cv::Vec3b* above = bgr.ptr<cv::Vec3b>(std::max(y - 1, 0));
    Signs* out = signs.ptr<Signs>(y);
    for (int x = 0; x < bgr.cols; ++x) {
      const auto [b, g, r] = row[x].val;
      const int across = std::abs(g - row[std::max(x - 1, 0)][1]);
      const int down = std::abs(g - above[x][1]);
      out[x] = {0.5f * static_cast<float>(across + down),
                static_cast<float>(g - std::max(b, r)),
                static_cast<float>(std::min(g, r) - b),
                static_cast<float>(g)};
    }
  }
  return signs;
}

// Median of every fourth pixel of every fourth row, at least 0.
float TypicalTint(const cv::Mat& signs, Sign tint) {
  std::vector<float> values;
  for (int y = 0; y < signs.rows; y += 4) {
    const Signs* row = signs.ptr<Signs>(y);
    for (int x = 0; x < signs.cols; x += 4) values.push_back(row[x][tint]);
  }
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return std::max(0.0f, *middle);
}

}  // namespace

cv::Mat FoliageMask(const cv::Mat& bgr) {
  const int window = static_cast<int>(std::lround(kWindowShare * std::max(bgr.cols, bgr.rows))) | 1;
  cv::Mat signs = SignsOf(bgr);
  cv::blur(signs, signs, cv::Size(window, window));
  signs.forEach<Signs>([](Signs& s, const int*) { s *= 1.0f / (s[kLevel] + kDark); });
  const float green = TypicalTint(signs, kGreen);
  const float yellow = TypicalTint(signs, kYellow);

  cv::Mat foliage(bgr.size(), CV_32F);
  foliage.forEach<float>([&](float& f, const int* at) {
    const Signs& s = signs.at<Signs>(at[0], at[1]);
    f = Ramp(s[kTexture], 0.05f, 0.12f) * std::max(Ramp(s[kGreen] - green, 0.02f, 0.06f),
                                                   Ramp(s[kYellow] - yellow, 0.2f, 0.35f));
  });
  cv::blur(foliage, foliage, cv::Size(window, window));
  return foliage > kThreshold;
}

}  // namespace ridgeline
