// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string_view>

namespace ridgeline {

// 64 well-mixed bits of a value (the finalizer of SplitMix64, Steele et al. 2014).
std::uint64_t MixBits(std::uint64_t value);

// 64-bit FNV-1a hash of a text: a stream key from a query id or a test name.
std::uint64_t HashText(std::string_view text);

// Counter-based random stream: value k is MixBits(key + (k + 1) * golden ratio) (SplitMix64).
// Streams are addressed by (seed, stage, index), so results do not depend on threads or order.
class Random {
 public:
  Random(std::uint64_t seed, std::uint64_t stage, std::uint64_t index = 0);

  // Uniform over all 64-bit values.
  std::uint64_t Next();
  // Uniform in [0, 1) with 53 bits.
  double Uniform();
  // Uniform in [lower, upper).
  double Uniform(double lower, double upper);
  // Standard normal (inverse of the normal distribution function; one uniform number each).
  double Normal();
  // Uniform in {0, ..., count - 1}; count > 0.
  std::uint64_t Below(std::uint64_t count);

 private:
  std::uint64_t state_;
};

// Quantile of the standard normal distribution, p in (0, 1); relative error below 1e-14
// (Wichura 1988, algorithm AS 241).
double NormalQuantile(double p);

}  // namespace ridgeline
