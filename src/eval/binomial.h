// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace ridgeline {

// Within so many standard deviations a normal error is in 95 % of cases.
inline constexpr double kNormal95 = 1.959963984540054;

struct Interval95 {
  double lower = 0.0;
  double upper = 0.0;
};

// Wilson's interval of a share at 95 %. `trials` are independent trials: where every picture is
// localized with several seeds, the pictures, since its seeds are not independent. It never closes
// on a point: 8 of 8 is 68 to 100 %. Without trials [0, 1]. Wilson 1927.
// @param share  [0, 1].
Interval95 WilsonInterval(double share, int trials);

// The exact interval of `hits` of `trials` at 95 %: at most 2.5 % of samples lie beyond each bound
// where it is the truth. Without trials [0, 1]. Clopper and Pearson 1934.
Interval95 ExactInterval(int hits, int trials);

}  // namespace ridgeline
