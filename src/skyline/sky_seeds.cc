// SPDX-License-Identifier: Apache-2.0
#include "skyline/sky_seeds.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
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
// But not if less of them is filled: bright facades have windows.
constexpr double kLeastFilled = 0.85;
// Largest contrasts [grey values] and least log odds of clouds beside the sky.
constexpr std::array<std::uint8_t, 4> kCloudContrasts{4, 6, 8, 12};
constexpr float kLeastCloudOdds = -1.5f;
constexpr double kLeastMeanOdds = 0.0;
// Labels while regions are told apart: closed, open but not reached yet, and the regions' own.
constexpr std::uint8_t kClosed = 0, kOpen = 1, kFirstRegion = 2, kLastRegion = 255;

struct Region {
  std::uint8_t label = 0;
  double likeliness = 0.0;
  double filled = 0.0;  // share without holes, as Shape's
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

// Calls visit(index) for the four neighbours of every pixel, also of those that it appends.
template <typename Visit>
void VisitNeighbours(int columns, int count, const std::vector<int>& pixels, const Visit& visit) {
  for (std::size_t next = 0; next < pixels.size(); ++next) {
    const int p = pixels[next];
    const int column = p % columns;
    if (column > 0) visit(p - 1);
    if (column < columns - 1) visit(p + 1);
    if (p >= columns) visit(p - columns);
    if (p + columns < count) visit(p + columns);
  }
}

// Adds to `pixels` (row-major indices) all pixels of value `open` that are connected with them,
// setting these to `taken`.
void Spread(std::uint8_t open, std::uint8_t taken, cv::Mat& labels, std::vector<int>& pixels) {
  const int columns = labels.cols;
  const int count = columns * labels.rows;
  std::uint8_t* l = labels.ptr();
  const auto visit = [&](int i) {
    if (l[i] != open) return;
    l[i] = taken;
    pixels.push_back(i);
  };
  VisitNeighbours(columns, count, pixels, visit);
}

// Takes a connected region from `labels`, starting in column x of the upper border.
void Fill(int x, std::uint8_t label, cv::Mat& labels, std::vector<int>& pixels) {
  pixels.assign(1, x);
  labels.ptr()[x] = label;
  Spread(kOpen, label, labels, pixels);
}

// Form of a region.
struct Shape {
  double area = 0.0;     // share of the picture
  double filled = 0.0;   // share of the pixels above its lowest in each column: 1 without holes
  double deepest = 0.0;  // lowest row, as a share of the height
};

// @param bottom  Lowest row of each column, -1: none.
Shape ShapeOf(const std::vector<int>& bottom, double pixels, const cv::Size& size) {
  double above = 0.0;
  for (const int b : bottom) above += b + 1;
  const double deepest = *std::max_element(bottom.begin(), bottom.end());
  return {pixels / size.area(), pixels / above, deepest / size.height};
}

Shape ShapeOf(const std::vector<int>& pixels, const cv::Size& size) {
  std::vector<int> bottom(static_cast<std::size_t>(size.width), -1);
  for (const int p : pixels) {
    int& b = bottom[static_cast<std::size_t>(p % size.width)];
    b = std::max(b, p / size.width);
  }
  return ShapeOf(bottom, static_cast<double>(pixels.size()), size);
}

Shape ShapeOf(const cv::Mat& mask) {
  std::vector<int> bottom(static_cast<std::size_t>(mask.cols), -1);
  for (int y = 0; y < mask.rows; ++y) {
    const std::uint8_t* m = mask.ptr(y);
    for (std::size_t x = 0; x < bottom.size(); ++x) {
      if (m[x] != 0) bottom[x] = y;
    }
  }
  return ShapeOf(bottom, cv::countNonZero(mask), mask.size());
}

// High for a large region that has no holes (as windows make) and does not reach deep into the
// picture.
double Compactness(const Shape& s) {
  return 4.0 * (s.filled - 1.0) - 2.5 * std::max(0.0, s.deepest - 0.5) + 0.5 * std::log(s.area);
}

double MeanOdds(const std::vector<int>& pixels, const cv::Mat& log_odds) {
  double sum = 0.0;
  for (const int p : pixels) sum += log_odds.ptr<float>()[p];
  return sum / static_cast<double>(pixels.size());
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
    const Shape shape = ShapeOf(pixels, log_odds.size());
    regions.list.push_back({label, MeanOdds(pixels, log_odds) + Compactness(shape), shape.filled});
    ++label;
  }
  return regions;
}

// What is reached from the seeds in small steps and is not unlike sky: clouds between and below the
// blue, mostly. Of several bounds on the steps, the one whose region is largest and has the fewest
// holes (windows). Empty if even that is unlike sky on the whole.
cv::Mat Clouds(const cv::Mat& log_odds, const cv::Mat& contrast, const cv::Mat& seeds) {
  const int columns = seeds.cols;
  const int count = columns * seeds.rows;
  const float* odds = log_odds.ptr<float>();
  const std::uint8_t* c = contrast.ptr();
  cv::Mat reached = seeds == kSkySeed;
  std::uint8_t* r = reached.ptr();
  std::vector<int> pixels, beyond;  // beyond: pixels next to them that took a larger step
  for (int i = 0; i < count; ++i) {
    if (r[i] != 0) pixels.push_back(i);
  }
  cv::Mat best;
  double most = -std::numeric_limits<double>::infinity();
  const cv::Mat kernel = cv::getStructuringElement(cv::MORPH_RECT, {3, 3});
  for (const std::uint8_t step : kCloudContrasts) {
    const auto visit = [&](int i) {
      if (r[i] != 0 || odds[i] <= kLeastCloudOdds) return;
      if (c[i] > step) {
        beyond.push_back(i);
        return;
      }
      r[i] = 255;
      pixels.push_back(i);
    };
    for (const int i : std::exchange(beyond, {})) visit(i);
    VisitNeighbours(columns, count, pixels, visit);
    pixels.clear();
    cv::Mat region;
    cv::morphologyEx(reached, region, cv::MORPH_CLOSE, kernel);  // small holes are filled
    if (cv::mean(log_odds, region)[0] < kLeastMeanOdds) continue;
    const double value = Compactness(ShapeOf(region));
    if (value < most) continue;
    most = value;
    best = std::move(region);
  }
  return best;
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
  ColourHistogram colours;                  // of the likeliest region, if it is asked for
  std::array<std::uint8_t, 256> meaning{};  // all kNotSkySeed
  for (const Region& r : regions.list) {
    if (r.label != best.label && r.filled < kLeastFilled) continue;
    bool sky = r.likeliness > best.likeliness - kAsLikely;
    if (!sky) {
      if (colours.empty()) colours = ColoursOf(features, regions.labels, best.label);
      sky = ColourOverlap(colours, ColoursOf(features, regions.labels, r.label)) > kSameColours;
    }
    if (sky) meaning[r.label] = kSkySeed;
  }
  cv::Mat seeds;
  cv::LUT(regions.labels, cv::Mat(1, 256, CV_8U, meaning.data()), seeds);
  const cv::Mat clouds = Clouds(log_odds, features.contrast, seeds);
  if (!clouds.empty()) seeds.setTo(kSkySeed, clouds);
  cv::Mat grown;
  cv::dilate(seeds == kSkySeed, grown, cv::getStructuringElement(cv::MORPH_RECT, {5, 5}));
  seeds.setTo(kMixedPixel, grown & (seeds == kNotSkySeed));
  return seeds;
}

}  // namespace ridgeline
