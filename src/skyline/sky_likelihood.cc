// SPDX-License-Identifier: Apache-2.0
#include "skyline/sky_likelihood.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "skyline/reduce.h"
#include "skyline/sky_features.h"
#include "skyline/sky_seeds.h"

namespace ridgeline {
namespace {

float Ramp(float value, float zero, float one) {
  return std::clamp((value - zero) / (one - zero), 0.0f, 1.0f);
}

// Brightness that only the brightest two hundredths exceed.
float HighLuma(const cv::Mat& luma) {
  std::array<int, 256> counts{};
  for (int y = 0; y < luma.rows; ++y) {
    const std::uint8_t* l = luma.ptr(y);
    for (int x = 0; x < luma.cols; ++x) ++counts[l[x]];
  }
  int left = static_cast<int>(luma.total() / 50);
  int value = 255;
  while (value > 1 && (left -= counts[static_cast<std::size_t>(value)]) > 0) --value;
  return static_cast<float>(value);
}

// What is known before the picture's own colours are: skies are bright or blue, smooth, neither
// warm nor green, and high in the picture.
cv::Mat PriorLogOdds(const cv::Mat& bgr, const SkyFeatures& f) {
  const float high = HighLuma(f.luma);
  cv::Mat out(bgr.size(), CV_32F);
  for (int y = 0; y < bgr.rows; ++y) {
    const std::uint8_t* p = bgr.ptr(y);
    const std::uint8_t* luma = f.luma.ptr(y);
    const std::uint8_t* contrast = f.contrast.ptr(y);
    float* o = out.ptr<float>(y);
    const float depth = (static_cast<float>(y) + 0.5f) / static_cast<float>(bgr.rows);
    const float place = 1.0f - 3.0f * depth * depth;
    for (int x = 0; x < bgr.cols; ++x, p += 3) {
      const float blue = static_cast<float>(p[0] - p[2]);
      const float green = static_cast<float>(p[1] - std::max(p[0], p[2]));
      const float brightness = static_cast<float>(luma[x]) / high;
      o[x] = place + 3.0f * Ramp(brightness, 0.55f, 0.95f) + 2.0f * Ramp(blue, 8.0f, 50.0f) - 2.0f -
             3.0f * Ramp(contrast[x], 8.0f, 30.0f) - 3.0f * Ramp(-blue, 12.0f, 40.0f) -
             3.0f * Ramp(green, 4.0f, 16.0f);
    }
  }
  return out;
}

// Log ratio of the colour densities of sky and not-sky per bin; 0 where neither was seen.
std::vector<float> ColourLogRatio(const SkyFeatures& features, const cv::Mat& seeds) {
  const ColourHistogram sky = ColoursOf(features, seeds, kSkySeed);
  const ColourHistogram rest = ColoursOf(features, seeds, kNotSkySeed);
  // A pixel in ten thousand as the density of what was never seen.
  constexpr float kUnseen = 1e-4f;
  std::vector<float> ratio(sky.size());
  for (std::size_t b = 0; b < ratio.size(); ++b) {
    if (sky[b] == 0.0f && rest[b] == 0.0f) continue;
    ratio[b] = std::log((sky[b] + kUnseen) / (rest[b] + kUnseen));
  }
  return ratio;
}

}  // namespace

cv::Mat SkyLogOdds(const cv::Mat& bgr, const SkyLikelihoodOptions& options) {
  const cv::Mat small = ReducedToWidth(bgr, options.work_width_px);
  const SkyFeatures f = MeasureSkyFeatures(small);
  const cv::Mat prior = PriorLogOdds(small, f);
  cv::Mat log_odds = prior.clone();
  const float limit = static_cast<float>(options.max_log_odds);
  for (int round = 0; round < options.rounds; ++round) {
    const std::vector<float> ratio = ColourLogRatio(f, SkySeeds(log_odds, f));
    std::size_t i = 0;
    for (int y = 0; y < log_odds.rows; ++y) {
      float* l = log_odds.ptr<float>(y);
      const float* p = prior.ptr<float>(y);
      for (int x = 0; x < log_odds.cols; ++x, ++i) {
        l[x] = std::clamp(0.5f * p[x] + ratio[f.bins[i]], -limit, limit);
      }
    }
  }
  return log_odds;
}

}  // namespace ridgeline
