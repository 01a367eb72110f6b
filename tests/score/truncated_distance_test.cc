// SPDX-License-Identifier: Apache-2.0
#include "score/truncated_distance.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/random.h"

namespace ridgeline {
namespace {

TEST(TruncatedDistance, IsWithinFourPercentOfBruteForce) {
  for (const auto& [width, height] : {std::pair{97, 61}, {5, 130}, {1, 1}, {64, 2}}) {
    Random random(7, static_cast<std::uint64_t>(width));
    std::vector<std::uint8_t> pixels(static_cast<std::size_t>(width) * height, 255);
    std::vector<std::pair<int, int>> zeros;
    for (int i = 0; i < 6; ++i) {
      const int x = static_cast<int>(random.Uniform() * width);
      const int y = static_cast<int>(random.Uniform() * height);
      pixels[static_cast<std::size_t>(y) * width + x] = 0;
      zeros.emplace_back(x, y);
    }
    TruncatedDistance(pixels, width, height, 8);
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        double nearest = 1e9;
        for (const auto& [zx, zy] : zeros) nearest = std::min(nearest, std::hypot(x - zx, y - zy));
        const double expected = std::min(255.0, 8.0 * nearest);
        ASSERT_NEAR(pixels[static_cast<std::size_t>(y) * width + x], expected, 0.04 * 8.0 * nearest)
            << width << " x " << height << " at " << x << ", " << y;
      }
    }
  }
}

TEST(TruncatedDistance, WithoutZerosAllIsFar) {
  std::vector<std::uint8_t> pixels(40 * 30, 255);
  TruncatedDistance(pixels, 40, 30, 8);
  EXPECT_TRUE(std::all_of(pixels.begin(), pixels.end(), [](std::uint8_t p) { return p == 255; }));
}

}  // namespace
}  // namespace ridgeline
