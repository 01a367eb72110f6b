// SPDX-License-Identifier: Apache-2.0
#include "skyline/sky_likelihood.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "base/error.h"

namespace ridgeline {
namespace {

float Ramp(float value, float zero, float one) {
  return std::clamp((value - zero) / (one - zero), 0.0f, 1.0f);
}

// Luma and local contrast [grey values], and the quantized colour of every pixel.
struct Features {
  cv::Mat luma;      // CV_8U
  cv::Mat contrast;  // CV_8U: largest step of luma within two pixels
  std::vector<std::uint16_t> bins;
};

// Colour histogram over luma, blue - red and green excess.
constexpr int kLumaBins = 32, kBlueBins = 32, kGreenBins = 16;
constexpr int kBins = kLumaBins * kBlueBins * kGreenBins;
using Histogram = std::vector<float>;

std::uint16_t BinOf(int blue, int green, int red, int luma) {
  const int l = luma / (256 / kLumaBins);
  const int b = std::clamp((blue - red) / 6 + kBlueBins / 2, 0, kBlueBins - 1);
  const int g = std::clamp((2 * green - blue - red) / 10 + kGreenBins / 2, 0, kGreenBins - 1);
  return static_cast<std::uint16_t>((l * kBlueBins + b) * kGreenBins + g);
}

Features FeaturesOf(const cv::Mat& bgr) {
  Features f;
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
cv::Mat PriorLogOdds(const cv::Mat& bgr, const Features& f) {
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

// Pixels above zero that hang together with the upper border through such pixels.
cv::Mat ConnectedToTop(const cv::Mat& log_odds) {
  cv::Mat mask(log_odds.size(), CV_8U, cv::Scalar(0));
  std::vector<cv::Point> stack;
  const auto visit = [&](int x, int y) {
    if (x < 0 || y < 0 || x >= mask.cols || y >= mask.rows || mask.at<std::uint8_t>(y, x) ||
        log_odds.at<float>(y, x) <= 0.0f) {
      return;
    }
    mask.at<std::uint8_t>(y, x) = 1;
    stack.emplace_back(x, y);
  };
  for (int x = 0; x < mask.cols; ++x) visit(x, 0);
  while (!stack.empty()) {
    const cv::Point p = stack.back();
    stack.pop_back();
    visit(p.x - 1, p.y);
    visit(p.x + 1, p.y);
    visit(p.x, p.y - 1);
    visit(p.x, p.y + 1);
  }
  return mask;
}

// Spreads every count over its neighbours along one axis of the histogram (weights 1/4, 1/2, 1/4).
void SmoothAxis(Histogram& h, int size, int stride) {
  Histogram out(h.size());
  for (int i = 0; i < kBins; ++i) {
    const int k = i / stride % size;
    const float low = h[static_cast<std::size_t>(k > 0 ? i - stride : i)];
    const float high = h[static_cast<std::size_t>(k < size - 1 ? i + stride : i)];
    out[static_cast<std::size_t>(i)] = 0.25f * (low + high) + 0.5f * h[static_cast<std::size_t>(i)];
  }
  h = std::move(out);
}

void Smooth(Histogram& h) {
  SmoothAxis(h, kGreenBins, 1);
  SmoothAxis(h, kBlueBins, kGreenBins);
  SmoothAxis(h, kLumaBins, kGreenBins * kBlueBins);
}

// Log ratio of the two groups' colour densities per bin; 0 where neither was seen.
Histogram ColourLogRatio(const Features& f, const cv::Mat& sky) {
  Histogram in(kBins, 0.0f), out(kBins, 0.0f);
  float in_count = 0.0f, out_count = 0.0f;
  std::size_t i = 0;
  for (int y = 0; y < sky.rows; ++y) {
    const std::uint8_t* s = sky.ptr(y);
    for (int x = 0; x < sky.cols; ++x, ++i) {
      (s[x] ? in : out)[f.bins[i]] += 1.0f;
      (s[x] ? in_count : out_count) += 1.0f;
    }
  }
  Smooth(in);
  Smooth(out);
  // A pixel in ten thousand as the density of what was never seen.
  const float in_scale = 1.0f / std::max(1.0f, in_count);
  const float out_scale = 1.0f / std::max(1.0f, out_count);
  constexpr float kUnseen = 1e-4f;
  Histogram ratio(kBins);
  for (std::size_t b = 0; b < ratio.size(); ++b) {
    ratio[b] = std::log((in[b] * in_scale + kUnseen) / (out[b] * out_scale + kUnseen));
  }
  return ratio;
}

}  // namespace

void SkyLikelihoodOptions::Validate() const {
  if (work_width_px < 16) {
    throw InputError("", "skyline.sky.work_width_px", std::to_string(work_width_px), "at least 16");
  }
  if (rounds < 0) throw InputError("", "skyline.sky.rounds", std::to_string(rounds), "at least 0");
  if (!(max_log_odds > 0.0)) {
    throw InputError("", "skyline.sky.max_log_odds", std::to_string(max_log_odds), "more than 0");
  }
}

cv::Mat SkyLogOdds(const cv::Mat& bgr, const SkyLikelihoodOptions& options) {
  cv::Mat small = bgr;
  if (bgr.cols > options.work_width_px) {
    const double scale = static_cast<double>(options.work_width_px) / bgr.cols;
    const int rows = std::max(1, static_cast<int>(std::lround(bgr.rows * scale)));
    cv::resize(bgr, small, {options.work_width_px, rows}, 0, 0, cv::INTER_AREA);
  }
  const Features f = FeaturesOf(small);
  const cv::Mat prior = PriorLogOdds(small, f);
  cv::Mat log_odds = prior.clone();
  const float limit = static_cast<float>(options.max_log_odds);
  for (int round = 0; round < options.rounds; ++round) {
    const cv::Mat sky = ConnectedToTop(log_odds);
    const Histogram ratio = ColourLogRatio(f, sky);
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
