// SPDX-License-Identifier: Apache-2.0
#include "eval/binomial.h"

#include <algorithm>
#include <cmath>

namespace ridgeline {
namespace {

constexpr double kTail = 0.025;

// Probability of at least `hits` of `trials`, each with probability p in (0, 1).
double UpperTail(int hits, int trials, double p) {
  double sum = 0.0;
  const double log_all = std::lgamma(trials + 1.0);
  for (int k = trials; k >= hits; --k) {
    sum += std::exp(log_all - std::lgamma(k + 1.0) - std::lgamma(trials - k + 1.0) +
                    k * std::log(p) + (trials - k) * std::log1p(-p));
  }
  return sum;
}

// The probability at which at least `hits` of `trials` are seen in kTail of all samples; > 0 hits.
double LowerBound(int hits, int trials) {
  double low = 0.0;
  double high = 1.0;
  constexpr int kBisections = 60;  // to the last bit of a double
  for (int i = 0; i < kBisections; ++i) {
    const double middle = 0.5 * (low + high);
    (UpperTail(hits, trials, middle) < kTail ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

}  // namespace

Interval95 WilsonInterval(double share, int trials) {
  if (trials <= 0) return {0.0, 1.0};
  const double n = trials;
  const double z2 = kNormal95 * kNormal95;
  const double middle = (share + z2 / (2.0 * n)) / (1.0 + z2 / n);
  const double half =
      kNormal95 / (1.0 + z2 / n) * std::sqrt(share * (1.0 - share) / n + z2 / (4.0 * n * n));
  return {std::max(0.0, middle - half), std::min(1.0, middle + half)};
}

Interval95 ExactInterval(int hits, int trials) {
  if (trials <= 0) return {0.0, 1.0};
  return {hits == 0 ? 0.0 : LowerBound(hits, trials),
          hits == trials ? 1.0 : 1.0 - LowerBound(trials - hits, trials)};
}

}  // namespace ridgeline
