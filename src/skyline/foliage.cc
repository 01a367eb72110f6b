// SPDX-License-Identifier: Apache-2.0
#include "skyline/foliage.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>

namespace ridgeline {
namespace {

// Columns to either side over which a column's signs are averaged.
constexpr int kHalfWindow = 5;
// Rows below the boundary that are looked at, as a share of the width; the first rows are mixtures
// of sky and what is below.
constexpr double kStripShare = 0.03;
constexpr int kMixedRows = 2;

float Rise(float value, float zero, float one) {
  return std::clamp((value - zero) / (one - zero), 0.0f, 1.0f);
}

// Signs of leaves in one column, each as a mean over the strip below the boundary.
struct Signs {
  float level = 0.0f;    // green channel
  float texture = 0.0f;  // step of green to the next pixel
  float green = 0.0f;    // green over the larger of red and blue
  float yellow = 0.0f;   // the smaller of red and green over blue
  float sky = 0.0f;      // share of pixels that look like sky
  float ragged = 0.0f;   // second difference of the boundary [px]
};

Signs Scaled(const Signs& s, float scale) {
  return {s.level * scale,
          s.texture * scale,
          s.green * scale,
          s.yellow * scale,
          s.sky * scale,
          s.ragged * scale};
}

Signs SignsBelow(const cv::Mat& bgr, const cv::Mat& log_odds, int column, int first, int last) {
  Signs s;
  const int count = last - first;
  if (count <= 0) return s;
  const int next = column + 1 < bgr.cols ? column + 1 : column - 1;
  for (int y = first; y < last; ++y) {
    const std::uint8_t* p = bgr.ptr(y) + 3 * column;
    const std::uint8_t* q = bgr.ptr(y) + 3 * next;
    const std::uint8_t* r = bgr.ptr(std::min(y + 1, bgr.rows - 1)) + 3 * column;
    s.level += p[1];
    s.texture += static_cast<float>(std::abs(p[1] - q[1]) + std::abs(p[1] - r[1])) * 0.5f;
    s.green += static_cast<float>(p[1] - std::max(p[0], p[2]));
    s.yellow += static_cast<float>(std::min(p[1], p[2]) - p[0]);
    s.sky += log_odds.at<float>(y, column) > 0.0f ? 1.0f : 0.0f;
  }
  const float scale = 1.0f / static_cast<float>(count);
  return Scaled(s, scale);
}

float Foliage(const Signs& s) {
  // Leaves in shadow are as green and as textured as in the sun, relative to their brightness.
  const float dark = 1.0f / (s.level + 20.0f);
  const float textured =
      std::max(Rise(s.texture, 6.0f, 16.0f), 0.8f * Rise(s.texture * dark, 0.03f, 0.12f));
  const float score = 1.1f * textured + 1.4f * Rise(s.green * dark, 0.05f, 0.15f) +
                      0.9f * textured * Rise(s.yellow * dark, 0.28f, 0.4f) +
                      0.8f * Rise(s.ragged, 0.8f, 3.0f) + 0.8f * Rise(s.sky, 0.05f, 0.3f);
  return Rise(score, 1.1f, 2.0f);
}

}  // namespace

std::vector<float> FoliageAlong(const cv::Mat& bgr,
                                const cv::Mat& log_odds,
                                const std::vector<int>& boundary) {
  const int columns = bgr.cols;
  const int strip = std::max(6, static_cast<int>(std::lround(kStripShare * columns)));
  std::vector<Signs> signs;
  signs.reserve(boundary.size());
  for (int c = 0; c < columns; ++c) {
    const int b = boundary[static_cast<std::size_t>(c)];
    const int first = b == 0 ? 0 : b + kMixedRows;
    Signs s = SignsBelow(bgr, log_odds, c, first, std::min(first + strip, bgr.rows));
    if (c > 0 && c + 1 < columns) {
      const int left = boundary[static_cast<std::size_t>(c - 1)];
      const int right = boundary[static_cast<std::size_t>(c + 1)];
      // Walls are single large jumps; only the many small ones of leaves should count.
      s.ragged = std::min(6.0f, static_cast<float>(std::abs(left + right - 2 * b)));
    }
    signs.push_back(s);
  }
  std::vector<float> foliage;
  foliage.reserve(boundary.size());
  for (int c = 0; c < columns; ++c) {
    const int from = std::max(0, c - kHalfWindow), to = std::min(columns, c + kHalfWindow + 1);
    Signs mean;
    for (int k = from; k < to; ++k) {
      const Signs& s = signs[static_cast<std::size_t>(k)];
      mean.level += s.level;
      mean.texture += s.texture;
      mean.green += s.green;
      mean.yellow += s.yellow;
      mean.sky += s.sky;
      mean.ragged += s.ragged;
    }
    const float scale = 1.0f / static_cast<float>(to - from);
    foliage.push_back(Foliage(Scaled(mean, scale)));
  }
  return foliage;
}

}  // namespace ridgeline
