// SPDX-License-Identifier: Apache-2.0
#include "skyline/sky_features.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <utility>

namespace ridgeline {
namespace {

constexpr int kLumaBins = 32, kBlueBins = 32, kGreenBins = 16;
constexpr int kBins = kLumaBins * kBlueBins * kGreenBins;

std::uint16_t BinOf(int blue, int green, int red, int luma) {
  const int l = luma / (256 / kLumaBins);
  const int b = std::clamp((blue - red) / 6 + kBlueBins / 2, 0, kBlueBins - 1);
  const int g = std::clamp((2 * green - blue - red) / 10 + kGreenBins / 2, 0, kGreenBins - 1);
  return static_cast<std::uint16_t>((l * kBlueBins + b) * kGreenBins + g);
}

// Spreads every count over its neighbours along one axis of the histogram (weights 1/4, 1/2, 1/4).
void SmoothAxis(ColourHistogram& h, std::size_t size, std::size_t stride) {
  ColourHistogram out(h.size());
  for (std::size_t i = 0; i < h.size(); ++i) {
    const std::size_t k = i / stride % size;
    const float low = h[k > 0 ? i - stride : i];
    const float high = h[k < size - 1 ? i + stride : i];
    out[i] = 0.25f * (low + high) + 0.5f * h[i];
  }
  h = std::move(out);
}

}  // namespace

SkyFeatures MeasureSkyFeatures(const cv::Mat& bgr) {
  SkyFeatures f;
  cv::cvtColor(bgr, f.luma, cv::COLOR_BGR2GRAY);
  const cv::Mat kernel = cv::getStructuringElement(cv::MORPH_RECT, {3, 3});
  cv::morphologyEx(f.luma, f.contrast, cv::MORPH_GRADIENT, kernel);
  f.bins.reserve(bgr.total());
  for (int y = 0; y < bgr.rows; ++y) {
    const std::uint8_t* p = bgr.ptr(y);
    const std::uint8_t* l = f.luma.ptr(y);
    for (int x = 0; x < bgr.cols; ++x, p += 3) f.bins.push_back(BinOf(p[0], p[1], p[2], l[x]));
  }
  return f;
}

ColourHistogram ColoursOf(const SkyFeatures& features, const cv::Mat& labels, std::uint8_t label) {
  ColourHistogram h(kBins, 0.0f);
  std::size_t count = 0;
  std::size_t i = 0;
  for (int y = 0; y < labels.rows; ++y) {
    const std::uint8_t* l = labels.ptr(y);
    for (int x = 0; x < labels.cols; ++x, ++i) {
      if (l[x] != label) continue;
      h[features.bins[i]] += 1.0f;
      ++count;
    }
  }
  if (count == 0) return h;
  for (float& value : h) value /= static_cast<float>(count);
  SmoothAxis(h, kGreenBins, 1);
  SmoothAxis(h, kBlueBins, kGreenBins);
  SmoothAxis(h, kLumaBins, kGreenBins * kBlueBins);
  return h;
}

double ColourOverlap(const ColourHistogram& a, const ColourHistogram& b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += std::sqrt(a[i] * b[i]);
  return sum;
}

}  // namespace ridgeline
