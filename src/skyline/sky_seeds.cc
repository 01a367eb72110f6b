// SPDX-License-Identifier: Apache-2.0
#include "skyline/sky_seeds.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <opencv2/imgproc.hpp>
#include <utility>
#include <vector>

namespace ridgeline {
namespace {

// Largest contrasts inside a smooth region [grey values]: a low one separates a bright facade from
// the sky, a high one keeps clouds together. The better result is taken.
constexpr std::array<std::uint8_t, 3> kSmoothContrasts{10, 6, 4};
// Regions below this share of the picture are left out.
constexpr double kLeastShare = 0.0005;
// Regions whose colours overlap this much with the likeliest one's are sky too.
constexpr double kSameColours = 0.6;
// So are those whose likeliness falls behind the likeliest one's by no more than this.
constexpr double kAsLikely = 0.5;
// Labels while regions are told apart: closed, open but not reached yet, and the regions' own.
constexpr std::uint8_t kClosed = 0, kOpen = 1, kFirstRegion = 2, kLastRegion = 255;

struct Region {
  std::uint8_t label = 0;
  double likeliness = 0.0;
};

struct Regions {
  cv::Mat labels;
  std::vector<Region> list;

  const Region& Likeliest() const {
    return *std::max_element(list.begin(), list.end(), [](const Region& a, const Region& b) {
      return a.likeliness < b.likeliness;
    });
  }
};

// Takes a connected region from `labels`, starting in column x of the upper border. Gives the
// pixels as row-major indices.
void Fill(int x, std::uint8_t label, cv::Mat& labels, std::vector<int>& pixels) {
  const int columns = labels.cols;
  const int count = columns * labels.rows;
  std::uint8_t* l = labels.ptr();
  pixels.assign(1, x);
  l[x] = label;
  const auto visit = [&](int i) {
    if (l[i] != kOpen) return;
    l[i] = label;
    pixels.push_back(i);
  };
  for (std::size_t next = 0; next < pixels.size(); ++next) {
    const int p = pixels[next];
    const int column = p % columns;
    if (column > 0) visit(p - 1);
    if (column < columns - 1) visit(p + 1);
    if (p >= columns) visit(p - columns);
    if (p + columns < count) visit(p + columns);
  }
}

// High for a large region of high mean log odds, that has no holes (as windows make) and does not
// reach deep into the picture.
double Likeliness(const std::vector<int>& pixels, const cv::Mat& log_odds) {
  std::vector<int> bottom(static_cast<std::size_t>(log_odds.cols), -1);
  const float* odds = log_odds.ptr<float>();
  double sum = 0.0;
  for (const int p : pixels) {
    sum += odds[p];
    int& b = bottom[static_cast<std::size_t>(p % log_odds.cols)];
    b = std::max(b, p / log_odds.cols);
  }
  double filled = 0.0;
  for (const int b : bottom) filled += b + 1;
  const double deepest = *std::max_element(bottom.begin(), bottom.end());
  const double area = static_cast<double>(pixels.size());
  return sum / area + 4.0 * (area / filled - 1.0) -
         2.5 * std::max(0.0, deepest / log_odds.rows - 0.5) +
         0.5 * std::log(area / static_cast<double>(log_odds.total()));
}

Regions SmoothRegionsAtTop(const cv::Mat& log_odds, const cv::Mat& contrast, std::uint8_t smooth) {
  Regions regions;
  regions.labels.create(log_odds.size(), CV_8U);
  for (int y = 0; y < log_odds.rows; ++y) {
    const float* l = log_odds.ptr<float>(y);
    const std::uint8_t* c = contrast.ptr(y);
    std::uint8_t* o = regions.labels.ptr(y);
    for (int x = 0; x < log_odds.cols; ++x) o[x] = l[x] > 0.0f && c[x] <= smooth ? kOpen : kClosed;
  }
  const double least = kLeastShare * static_cast<double>(log_odds.total());
  std::uint8_t label = kFirstRegion;
  std::vector<int> pixels;
  for (int x = 0; x < log_odds.cols && label < kLastRegion; ++x) {
    if (regions.labels.at<std::uint8_t>(0, x) != kOpen) continue;
    Fill(x, label, regions.labels, pixels);
    if (static_cast<double>(pixels.size()) < least) {
      for (const int p : pixels) regions.labels.ptr()[p] = kClosed;
      continue;
    }
    regions.list.push_back({label, Likeliness(pixels, log_odds)});
    ++label;
  }
  return regions;
}

}  // namespace

cv::Mat SkySeeds(const cv::Mat& log_odds, const SkyFeatures& features) {
  Regions regions;
  for (const std::uint8_t smooth : kSmoothContrasts) {
    Regions found = SmoothRegionsAtTop(log_odds, features.contrast, smooth);
    if (found.list.empty()) continue;
    if (regions.list.empty() || found.Likeliest().likeliness > regions.Likeliest().likeliness) {
      regions = std::move(found);
    }
  }
  if (regions.list.empty()) return cv::Mat(log_odds.size(), CV_8U, cv::Scalar(kNotSkySeed));

  const Region& best = regions.Likeliest();
  const ColourHistogram colours = ColoursOf(features, regions.labels, best.label);
  std::array<std::uint8_t, 256> meaning{};  // all kNotSkySeed
  for (const Region& r : regions.list) {
    const bool sky =
        r.likeliness > best.likeliness - kAsLikely ||
        ColourOverlap(colours, ColoursOf(features, regions.labels, r.label)) > kSameColours;
    if (sky) meaning[r.label] = kSkySeed;
  }
  cv::Mat seeds;
  cv::LUT(regions.labels, cv::Mat(1, 256, CV_8U, meaning.data()), seeds);
  cv::Mat grown;
  cv::dilate(seeds, grown, cv::getStructuringElement(cv::MORPH_RECT, {5, 5}));
  seeds.setTo(kMixedPixel, grown != seeds);
  return seeds;
}

}  // namespace ridgeline
