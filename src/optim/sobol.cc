// SPDX-License-Identifier: Apache-2.0
#include "optim/sobol.h"

#include <boost/random/sobol.hpp>
#include <memory>

#include "base/random.h"
#include "optim/sampler_plugin.h"

namespace ridgeline {
namespace {

std::uint32_t ReverseBits(std::uint32_t x) {
  x = (x >> 16) | (x << 16);
  x = ((x & 0x00FF00FFU) << 8) | ((x & 0xFF00FF00U) >> 8);
  x = ((x & 0x0F0F0F0FU) << 4) | ((x & 0xF0F0F0F0U) >> 4);
  x = ((x & 0x33333333U) << 2) | ((x & 0xCCCCCCCCU) >> 2);
  return ((x & 0x55555555U) << 1) | ((x & 0xAAAAAAAAU) >> 1);
}

// Burley, "Practical Hash-based Owen Scrambling", JCGT 9(4), 2020, listing 3: each bit is flipped
// by a hash of the bits above it.
std::uint32_t Scramble(std::uint32_t x, std::uint32_t seed) {
  x = ReverseBits(x);
  x += seed;
  x ^= x * 0x6C50B47CU;
  x ^= x * 0xB82F1E52U;
  x ^= x * 0xC7AFE638U;
  x ^= x * 0x8D22F6E6U;
  return ReverseBits(x);
}

}  // namespace

struct SobolSequence::Engine {
  explicit Engine(std::size_t dimension) : sobol(dimension) {}
  boost::random::sobol_engine<std::uint32_t, 32U> sobol;
  bool at_origin = true;
};

SobolSequence::SobolSequence(std::size_t dimension, std::uint64_t seed)
    : engine_(std::make_unique<Engine>(dimension)) {
  static const std::uint64_t kStage = HashText("optim.sobol");
  for (std::size_t d = 0; d < dimension; ++d) {
    seeds_.push_back(static_cast<std::uint32_t>(Random(seed, kStage, d).Next() >> 32));
  }
}

SobolSequence::~SobolSequence() = default;

UnitPoint SobolSequence::Next() {
  UnitPoint point;
  for (const std::uint32_t seed : seeds_) {
    // Boost leaves out the origin, without which 2^k points are not even.
    const std::uint32_t bits = engine_->at_origin ? 0 : engine_->sobol();
    point.push_back((static_cast<double>(Scramble(bits, seed)) + 0.5) * 0x1.0p-32);
  }
  engine_->at_origin = false;
  return point;
}

extern const SamplerPlugin kSobolSampler;
constinit const SamplerPlugin kSobolSampler = {
    .name = "sobol",
    .declare = [](OptionGroups&) {},
    .make = [](const StrategyContext& context, const OptionGroups& /*options*/)
        -> std::unique_ptr<Strategy> { return std::make_unique<SobolStrategy>(context); }};

}  // namespace ridgeline
