// SPDX-License-Identifier: Apache-2.0
#include "base/decimals.h"

#include <array>
#include <charconv>
#include <cmath>

namespace ridgeline {

// Powers of ten are exact up to 1e22 and the division rounds once: the nearest double.
double RoundedTo(double value, int decimals) {
  constexpr double kExactIntegers = 9007199254740992.0;  // 2^53
  const double scale = std::pow(10.0, decimals);
  const double scaled = value * scale;
  if (!(std::abs(scaled) < kExactIntegers)) return value;
  const double rounded = std::round(scaled) / scale;
  return rounded == 0.0 ? 0.0 : rounded;  // no minus zero
}

std::string ShortestText(double value) {
  std::array<char, 32> text{};
  const auto [end, error] = std::to_chars(text.data(), text.data() + text.size(), value);
  return std::string(text.data(), end);
}

}  // namespace ridgeline
