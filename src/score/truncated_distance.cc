// SPDX-License-Identifier: Apache-2.0
#include "score/truncated_distance.h"

#include <algorithm>
#include <cstddef>
#include <vector>

namespace ridgeline {
namespace {

// Steps of the mask [1/8 px]: along an axis, diagonal, knight's move.
constexpr std::uint8_t kAxis = 8;
constexpr std::uint8_t kDiagonal = 11;
constexpr std::uint8_t kKnight = 18;
// Runs along a row are spread by steps of 1, 2, 4, 8 and 16 px: 31 px in all.
constexpr int kLongestStep = 16;

inline std::uint8_t Plus(std::uint8_t value, std::uint8_t step) {
  return static_cast<std::uint8_t>(std::min<std::uint8_t>(value, 255 - step) + step);
}

// target = min(target, source + step)
void Lower(std::uint8_t* __restrict target,
           const std::uint8_t* source,
           std::uint8_t step,
           int count) {
  for (int x = 0; x < count; ++x) target[x] = std::min(target[x], Plus(source[x], step));
}

// target = the least of source and its neighbours `step` pixels to the left and right
void Spread(std::uint8_t* __restrict target, const std::uint8_t* source, int step, int count) {
  const auto cost = static_cast<std::uint8_t>(step * kAxis);
  for (int x = 0; x < count; ++x) {
    const std::uint8_t beside = std::min(source[x - step], source[x + step]);
    target[x] = std::min(source[x], Plus(beside, cost));
  }
}

// A row with 255 on both sides.
class PaddedRow {
 public:
  explicit PaddedRow(int width)
      : width_(width), pixels_(static_cast<std::size_t>(width) + 2 * kLongestStep, 255) {}

  std::uint8_t* data() { return pixels_.data() + kLongestStep; }
  void Load(const std::uint8_t* row) { std::copy_n(row, width_, data()); }
  void Store(std::uint8_t* row) { std::copy_n(data(), width_, row); }
  void Swap(PaddedRow& other) { pixels_.swap(other.pixels_); }

 private:
  int width_;
  std::vector<std::uint8_t> pixels_;
};

// One pass over the rows, each lowered by the two before it.
void Pass(std::span<std::uint8_t> pixels, int width, int height, bool downwards) {
  PaddedRow row(width);
  PaddedRow spread(width);
  PaddedRow last(width);
  PaddedRow before_last(width);
  for (int i = 0; i < height; ++i) {
    const int y = downwards ? i : height - 1 - i;
    std::uint8_t* stored = pixels.data() + static_cast<std::size_t>(y) * width;
    row.Load(stored);
    Lower(row.data(), last.data(), kAxis, width);
    for (const int side : {-1, 1}) {
      Lower(row.data(), last.data() + side, kDiagonal, width);
      Lower(row.data(), last.data() + 2 * side, kKnight, width);
      Lower(row.data(), before_last.data() + side, kKnight, width);
    }
    for (int step = 1; step <= kLongestStep; step *= 2) {
      Spread(spread.data(), row.data(), step, width);
      row.Swap(spread);
    }
    row.Store(stored);
    before_last.Swap(last);
    last.Swap(row);
  }
}

}  // namespace

void TruncatedDistance(std::span<std::uint8_t> pixels, int width, int height) {
  Pass(pixels, width, height, true);
  Pass(pixels, width, height, false);
}

}  // namespace ridgeline
