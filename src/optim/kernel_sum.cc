// SPDX-License-Identifier: Apache-2.0
#include "optim/kernel_sum.h"

#include <algorithm>
#include <cstdint>
#include <cstring>

namespace ridgeline {
namespace {

#define RIDGELINE_INLINE __attribute__((always_inline)) inline

// Points worked on per call, and vectors of them worked on together, so that the arithmetic of one
// fills the waits of another.
constexpr std::size_t kBlock = 24;
constexpr std::size_t kVectors = 3;

// Points side by side in a register.
template <std::size_t kWidth>
struct Register {
  using Lanes [[gnu::vector_size(kWidth * sizeof(double))]] = double;
  using Bits [[gnu::vector_size(kWidth * sizeof(double))]] = std::int64_t;
};

constexpr double kLargestExponent = 1000.0;
// Adding it rounds to a whole number, which then stands in the low bits.
constexpr double kRounder = 0x1.8p52;

template <typename Lanes>
RIDGELINE_INLINE Lanes Load(const double* values) {
  Lanes lanes;
  std::memcpy(&lanes, values, sizeof(lanes));
  return lanes;
}

// 2^-t for t >= 0: 2^-n times a polynomial in the rest r, |r| <= 1/2 (interpolated at the Chebyshev
// nodes; relative error 2e-14).
template <typename Lanes, typename Bits>
RIDGELINE_INLINE Lanes ExpMinus(Lanes exponent) {
  const Lanes limit = Lanes{} + kLargestExponent;
  const Lanes t = exponent < limit ? exponent : limit;
  const Lanes rounded = t + kRounder;
  const Lanes r = (rounded - kRounder) - t;
  Lanes series = r * 1.0205905413765595e-07 + 1.3259645244887111e-06;
  series = series * r + 1.5252672924850737e-05;
  series = series * r + 0.0001540343375125101;
  series = series * r + 0.0013333558200794592;
  series = series * r + 0.0096181291939343126;
  series = series * r + 0.05550410866465167;
  series = series * r + 0.24022650695640341;
  series = series * r + 0.69314718055994617;
  series = series * r + 1.0000000000000135;
  const Bits power = reinterpret_cast<Bits>(rounded) << 52;
  return reinterpret_cast<Lanes>(reinterpret_cast<Bits>(series) - power);
}

// A periodic kernel's value, into the exponent of the product or its factor.
template <typename Lanes, typename Bits>
RIDGELINE_INLINE void AddPeriodic(const AxisKernel& kernel,
                                  Lanes x,
                                  Lanes& exponent,
                                  Lanes& factor) {
  const Lanes forth = x - kernel.mu;
  const Lanes way = forth < 0.0 ? -forth : forth;
  const Lanes z = (way < 1.0 - way ? way : 1.0 - way) * kernel.scale;
  if (kernel.images == 0) {
    exponent += z * z;
    return;
  }
  Lanes sum = {};
  for (int image = -kernel.images; image <= kernel.images; ++image) {
    const Lanes away = z + image * kernel.scale;
    sum += ExpMinus<Lanes, Bits>(away * away);
  }
  factor *= sum;
}

// One linear dimension: the way of the univariate sampler.
template <typename Lanes, typename Bits>
RIDGELINE_INLINE void SumLine(const std::vector<AxisKernel>& kernels,
                              const double* coefficients,
                              const double* points,
                              Lanes* sums) {
  constexpr std::size_t kWidth = sizeof(Lanes) / sizeof(double);
  Lanes x[kVectors];
  for (std::size_t v = 0; v < kVectors; ++v) x[v] = Load<Lanes>(points + v * kWidth);
  for (std::size_t k = 0; k < kernels.size(); ++k) {
    const double mu = kernels[k].mu;
    const double scale = kernels[k].scale;
    for (std::size_t v = 0; v < kVectors; ++v) {
      const Lanes z = (x[v] - mu) * scale;
      sums[v] += ExpMinus<Lanes, Bits>(z * z) * coefficients[k];
    }
  }
}

template <typename Lanes, typename Bits>
RIDGELINE_INLINE void SumProducts(std::span<const KernelAxis> axes,
                                  std::span<const double> coefficients,
                                  const double* points,
                                  Lanes* sums) {
  constexpr std::size_t kWidth = sizeof(Lanes) / sizeof(double);
  for (std::size_t k = 0; k < coefficients.size(); ++k) {
    for (std::size_t v = 0; v < kVectors; ++v) {
      Lanes exponent = {};
      Lanes factor = exponent + coefficients[k];
      for (std::size_t d = 0; d < axes.size(); ++d) {
        const AxisKernel& kernel = axes[d].kernels[k];
        const Lanes x = Load<Lanes>(points + d * kBlock + v * kWidth);
        if (axes[d].periodic) {
          AddPeriodic<Lanes, Bits>(kernel, x, exponent, factor);
        } else {
          const Lanes z = (x - kernel.mu) * kernel.scale;
          exponent += z * z;
        }
      }
      sums[v] += ExpMinus<Lanes, Bits>(exponent) * factor;
    }
  }
}

template <std::size_t kWidth>
RIDGELINE_INLINE void SumBlock(std::span<const KernelAxis> axes,
                               std::span<const double> coefficients,
                               const double* points,
                               double* result) {
  using Lanes = typename Register<kWidth>::Lanes;
  using Bits = typename Register<kWidth>::Bits;
  for (std::size_t begin = 0; begin < kBlock; begin += kVectors * kWidth) {
    Lanes sums[kVectors] = {};
    if (axes.size() == 1 && !axes[0].periodic) {
      SumLine<Lanes, Bits>(axes[0].kernels, coefficients.data(), points + begin, sums);
    } else {
      SumProducts<Lanes, Bits>(axes, coefficients, points + begin, sums);
    }
    std::memcpy(result + begin, sums, sizeof(sums));
  }
}

using BlockFunction = void (*)(std::span<const KernelAxis>,
                               std::span<const double>,
                               const double*,
                               double*);

void SumBlockAnywhere(std::span<const KernelAxis> axes,
                      std::span<const double> coefficients,
                      const double* points,
                      double* sums) {
  SumBlock<2>(axes, coefficients, points, sums);
}

#if defined(__x86_64__) && defined(__GNUC__)

__attribute__((target("avx2,fma"))) void SumBlockOnAvx2(std::span<const KernelAxis> axes,
                                                        std::span<const double> coefficients,
                                                        const double* points,
                                                        double* sums) {
  SumBlock<4>(axes, coefficients, points, sums);
}

__attribute__((target("avx512f,avx512dq,fma"))) void SumBlockOnAvx512(
    std::span<const KernelAxis> axes,
    std::span<const double> coefficients,
    const double* points,
    double* sums) {
  SumBlock<8>(axes, coefficients, points, sums);
}

BlockFunction BestFunction() {
  if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq")) {
    return SumBlockOnAvx512;
  }
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) return SumBlockOnAvx2;
  return SumBlockAnywhere;
}

#else

BlockFunction BestFunction() { return SumBlockAnywhere; }

#endif

}  // namespace

std::vector<double> KernelSums(std::span<const KernelAxis> axes,
                               std::span<const double> coefficients,
                               const std::vector<std::vector<double>>& points) {
  static const BlockFunction kSumBlock = BestFunction();
  const std::size_t count = points[0].size();
  std::vector<double> result(count);
  std::vector<double> block(axes.size() * kBlock);
  for (std::size_t begin = 0; begin < count; begin += kBlock) {
    const std::size_t size = std::min(kBlock, count - begin);
    for (std::size_t d = 0; d < axes.size(); ++d) {
      std::copy_n(&points[d][begin], size, &block[d * kBlock]);
    }
    double sums[kBlock];
    kSumBlock(axes, coefficients, block.data(), sums);
    std::copy_n(sums, size, &result[begin]);
  }
  return result;
}

}  // namespace ridgeline
