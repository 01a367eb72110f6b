// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "base/random.h"
#include "synth/renderer.h"

namespace ridgeline {
namespace {

constexpr double kContrast = 1.25;

}  // namespace

cv::Mat DevelopPhoto(const cv::Mat& radiance, std::uint64_t key) {
  Random random(key, 0x70);
  cv::Mat blurred;
  cv::GaussianBlur(radiance, blurred, {0, 0}, random.Uniform(0.45, 0.85));
  // Exposed for the mean, as a camera's automatic would, with its usual error.
  const cv::Scalar mean = cv::mean(radiance);
  const double exposure = 0.40 / std::max(1e-3, (mean[0] + mean[1] + mean[2]) / 3.0) *
                          std::exp2(random.Uniform(-0.35, 0.35));
  const cv::Vec3f balance(static_cast<float>(exposure * random.Uniform(0.94, 1.06)),
                          static_cast<float>(exposure),
                          static_cast<float>(exposure * random.Uniform(0.94, 1.06)));
  const double noise = random.Uniform(0.004, 0.014);
  cv::Mat photo(radiance.size(), CV_8UC3);
  for (int y = 0; y < photo.rows; ++y) {
    Random grain(key, 0x71, static_cast<std::uint64_t>(y));
    const auto* in = blurred.ptr<cv::Vec3f>(y);
    auto* out = photo.ptr<cv::Vec3b>(y);
    for (int x = 0; x < photo.cols; ++x) {
      for (int c = 0; c < 3; ++c) {
        const float light = in[x][c] * balance[c];
        // A shoulder keeps sunlit walls below white.
        const float mapped = light * (1.0f + light / 4.0f) / (1.0f + light);
        // Four uniform numbers: near enough to a normal one, and quick.
        const std::uint64_t bits = grain.Next();
        double sum = 0.0;
        for (int k = 0; k < 4; ++k) sum += static_cast<double>((bits >> (16 * k)) & 0xFFFF);
        const double normal = (sum / 65536.0 - 2.0) * std::sqrt(3.0);
        const double tone = std::pow(std::max(0.0f, mapped), 1.0 / 2.2);
        const double value = 0.5 + kContrast * (tone - 0.5) + noise * normal;
        out[x][2 - c] = cv::saturate_cast<uchar>(255.0 * value);
      }
    }
  }
  return photo;
}

}  // namespace ridgeline
