// SPDX-License-Identifier: Apache-2.0
#include "base/random.h"

#include <array>
#include <cmath>

namespace ridgeline {
namespace {

constexpr std::uint64_t kGoldenRatio = 0x9E3779B97F4A7C15ULL;

// Coefficients of rising powers.
double Polynomial(const std::array<double, 8>& coefficients, double x) {
  double sum = 0.0;
  for (auto it = coefficients.rbegin(); it != coefficients.rend(); ++it) sum = sum * x + *it;
  return sum;
}

}  // namespace

std::uint64_t MixBits(std::uint64_t value) {
  value = (value ^ (value >> 30)) * 0xBF58476D1CE4E5B9ULL;
  value = (value ^ (value >> 27)) * 0x94D049BB133111EBULL;
  return value ^ (value >> 31);
}

std::uint64_t HashText(std::string_view text) {
  std::uint64_t hash = 0xCBF29CE484222325ULL;
  for (const char c : text) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001B3ULL;
  return hash;
}

Random::Random(std::uint64_t seed, std::uint64_t stage, std::uint64_t index)
    : state_(MixBits(MixBits(MixBits(seed + kGoldenRatio) ^ stage) + kGoldenRatio * index)) {}

std::uint64_t Random::Next() {
  state_ += kGoldenRatio;
  return MixBits(state_);
}

double Random::Uniform() { return static_cast<double>(Next() >> 11) * 0x1.0p-53; }

double Random::Uniform(double lower, double upper) { return lower + (upper - lower) * Uniform(); }

double Random::Normal() {
  return NormalQuantile((static_cast<double>(Next() >> 11) + 0.5) * 0x1.0p-53);
}

std::uint64_t Random::Below(std::uint64_t count) {
  // Rejection keeps the result exactly uniform.
  const std::uint64_t limit = UINT64_MAX - UINT64_MAX % count;
  std::uint64_t value = Next();
  while (value >= limit) value = Next();
  return value % count;
}

double NormalQuantile(double p) {
  constexpr std::array<double, 8> kCenter = {3.387132872796366608,
                                             133.14166789178437745,
                                             1971.5909503065514427,
                                             13731.693765509461125,
                                             45921.953931549871457,
                                             67265.770927008700853,
                                             33430.575583588128105,
                                             2509.0809287301226727};
  constexpr std::array<double, 8> kUnderCenter = {1.0,
                                                  42.313330701600911252,
                                                  687.1870074920579083,
                                                  5394.1960214247511077,
                                                  21213.794301586595867,
                                                  39307.89580009271061,
                                                  28729.085735721942674,
                                                  5226.495278852545925};
  constexpr std::array<double, 8> kTail = {1.42343711074968357734,
                                           4.6303378461565452959,
                                           5.7694972214606914055,
                                           3.64784832476320460504,
                                           1.27045825245236838258,
                                           0.24178072517745061177,
                                           0.0227238449892691845833,
                                           7.7454501427834140764e-4};
  constexpr std::array<double, 8> kUnderTail = {1.0,
                                                2.05319162663775882187,
                                                1.6763848301838038494,
                                                0.68976733498510000455,
                                                0.14810397642748007459,
                                                0.0151986665636164571966,
                                                5.475938084995344946e-4,
                                                1.05075007164441684324e-9};
  constexpr std::array<double, 8> kFar = {6.6579046435011037772,
                                          5.4637849111641143699,
                                          1.7848265399172913358,
                                          0.29656057182850489123,
                                          0.026532189526576123093,
                                          0.0012426609473880784386,
                                          2.71155556874348757815e-5,
                                          2.01033439929228813265e-7};
  constexpr std::array<double, 8> kUnderFar = {1.0,
                                               0.59983220655588793769,
                                               0.13692988092273580531,
                                               0.0148753612908506148525,
                                               7.868691311456132591e-4,
                                               1.8463183175100546818e-5,
                                               1.4215117583164458887e-7,
                                               2.04426310338993978564e-15};
  const double q = p - 0.5;
  if (std::abs(q) <= 0.425) {
    const double r = 0.180625 - q * q;
    return q * Polynomial(kCenter, r) / Polynomial(kUnderCenter, r);
  }
  const double r = std::sqrt(-std::log(q < 0.0 ? p : 1.0 - p));
  const double x = r <= 5.0 ? Polynomial(kTail, r - 1.6) / Polynomial(kUnderTail, r - 1.6)
                            : Polynomial(kFar, r - 5.0) / Polynomial(kUnderFar, r - 5.0);
  return q < 0.0 ? -x : x;
}

}  // namespace ridgeline
