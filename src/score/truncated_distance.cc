// SPDX-License-Identifier: Apache-2.0
#include "score/truncated_distance.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace ridgeline {
namespace {

// Runs along a row are spread by steps of 1, 2, 4, 8 and 16 pixels, as far as a distance can tell.
constexpr int kLongestStep = 16;

// Steps of the mask: along an axis, diagonal, knight's move.
struct Steps {
  explicit Steps(int unit)
      : axis(static_cast<std::uint8_t>(unit)),
        diagonal(static_cast<std::uint8_t>(std::lround(unit * std::sqrt(2.0)))),
        knight(static_cast<std::uint8_t>(std::lround(unit * std::sqrt(5.0)))) {}
  std::uint8_t axis, diagonal, knight;
};

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
void Spread(std::uint8_t* __restrict target,
            const std::uint8_t* source,
            int step,
            std::uint8_t cost,
            int count) {
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
void Pass(
    std::span<std::uint8_t> pixels, int width, int height, const Steps& steps, bool downwards) {
  PaddedRow row(width);
  PaddedRow spread(width);
  PaddedRow last(width);
  PaddedRow before_last(width);
  for (int i = 0; i < height; ++i) {
    const int y = downwards ? i : height - 1 - i;
    std::uint8_t* stored = pixels.data() + static_cast<std::size_t>(y) * width;
    row.Load(stored);
    Lower(row.data(), last.data(), steps.axis, width);
    for (const int side : {-1, 1}) {
      Lower(row.data(), last.data() + side, steps.diagonal, width);
      Lower(row.data(), last.data() + 2 * side, steps.knight, width);
      Lower(row.data(), before_last.data() + side, steps.knight, width);
    }
    for (int step = 1; step <= kLongestStep && step * steps.axis < 255; step *= 2) {
      const auto cost = static_cast<std::uint8_t>(step * steps.axis);
      Spread(spread.data(), row.data(), step, cost, width);
      row.Swap(spread);
    }
    row.Store(stored);
    before_last.Swap(last);
    last.Swap(row);
  }
}

}  // namespace

void TruncatedDistance(std::span<std::uint8_t> pixels, int width, int height, int unit) {
  const Steps steps(unit);
  Pass(pixels, width, height, steps, true);
  Pass(pixels, width, height, steps, false);
}

}  // namespace ridgeline
