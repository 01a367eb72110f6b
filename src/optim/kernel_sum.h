// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace ridgeline {

// A normal distribution along one dimension of the unit cube.
struct AxisKernel {
  double mu = 0.5;
  double sigma = 1.0;
  // Of the exponent to base 2, 2^-((x - mu) scale)^2 = exp(-((x - mu) / sigma)^2 / 2); 0: uniform.
  double scale = 0.0;
  // Linear dimensions: the probability below 0 and that in [0, 1].
  double below = 0.0;
  double mass = 1.0;
  // Periodic dimensions: the density counts those at mu - images, ..., mu + images.
  int images = 0;
};

// The kernels of a mixture along one dimension.
struct KernelAxis {
  bool periodic = false;
  std::vector<AxisKernel> kernels;
};

// 2^(1/2 log2(e)): what makes a kernel's scale of 1 / sigma.
inline constexpr double kBinaryScale = 0.84932180028801904272;

// Unnormalised densities of a mixture at points (points[d][i] is coordinate d of point i): the sum
// over kernels of coefficients[k] times the product over dimensions of the kernel's values, each 1
// at its centre. Relative error below 1e-12; exponents beyond 2^-1000 count as that. Vector code,
// by eight points at once. Each point's sum runs in the order of the kernels, so the result is the
// same whatever the other points; without fused multiplication (before AVX2) the last bits differ.
std::vector<double> KernelSums(std::span<const KernelAxis> axes,
                               std::span<const double> coefficients,
                               const std::vector<std::vector<double>>& points);

}  // namespace ridgeline
