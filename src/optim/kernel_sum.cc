// SPDX-License-Identifier: Apache-2.0
#include "optim/kernel_sum.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <numbers>

namespace ridgeline {
namespace {

// Partial sums, so that the loop has no chain of dependent additions.
constexpr std::size_t kBlock = 64;
constexpr double kLargestExponent = 700.0;
// Adding it rounds to a whole number, which then stands in the low bits.
constexpr double kRounder = 0x1.8p52;

// exp(-t) for t in [0, kLargestExponent] without branches, so that loops of it become vector code:
// 2^-n times the Taylor series of exp(-r), |r| <= ln(2) / 2.
__attribute__((always_inline)) inline double ExpMinus(double t) {
  const double binary = t * std::numbers::log2e;
  const double rounded = binary + kRounder;
  const double r = (rounded - kRounder - binary) * std::numbers::ln2;
  double series = 1.0 / 39916800.0;
  series = series * r + 1.0 / 3628800.0;
  series = series * r + 1.0 / 362880.0;
  series = series * r + 1.0 / 40320.0;
  series = series * r + 1.0 / 5040.0;
  series = series * r + 1.0 / 720.0;
  series = series * r + 1.0 / 120.0;
  series = series * r + 1.0 / 24.0;
  series = series * r + 1.0 / 6.0;
  series = series * r + 0.5;
  series = series * r + 1.0;
  series = series * r + 1.0;
  const std::uint64_t n = std::bit_cast<std::uint64_t>(rounded);
  return series * std::bit_cast<double>((std::uint64_t{1023} - n) << 52);
}

__attribute__((always_inline)) inline double Sum(const double* squares,
                                                 const double* weights,
                                                 std::size_t count) {
  std::array<double, kBlock> sums = {};
  for (std::size_t begin = 0; begin < count; begin += kBlock) {
    const std::size_t size = std::min(kBlock, count - begin);
    for (std::size_t i = 0; i < size; ++i) {
      const double t = std::min(0.5 * squares[begin + i], kLargestExponent);
      sums[i] += weights[begin + i] * ExpMinus(t);
    }
  }
  double sum = 0.0;
  for (const double part : sums) sum += part;
  return sum;
}

}  // namespace

#if defined(__x86_64__) && defined(__GNUC__)

__attribute__((target("avx2,fma"))) static double SumOnAvx2(const double* squares,
                                                            const double* weights,
                                                            std::size_t count) {
  return Sum(squares, weights, count);
}

double KernelSum(const double* squares, const double* weights, std::size_t count) {
  static const bool kAvx2 = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
  return kAvx2 ? SumOnAvx2(squares, weights, count) : Sum(squares, weights, count);
}

#else

double KernelSum(const double* squares, const double* weights, std::size_t count) {
  return Sum(squares, weights, count);
}

#endif

}  // namespace ridgeline
