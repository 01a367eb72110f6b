// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "base/random.h"
#include "optim/kernel_sum.h"

namespace ridgeline {

// Coordinates by dimension: columns[d][i] is coordinate d of point i.
using Columns = std::vector<std::vector<double>>;

// How wide the kernel of a point is.
enum class BandwidthRule {
  // One dimension: the larger of the gaps to the neighbours, the prior's centre being one of them
  // (Bergstra et al. 2011, 4.2).
  kNeighbours,
  // Any dimension: 0.2 n^(-1/(d + 4)) of the range, for all points (Falkner et al. 2018, BOHB).
  kScott,
};

struct ParzenOptions {
  BandwidthRule rule = BandwidthRule::kNeighbours;
  double prior_weight = 1.0;
  bool magic_clip = true;
  bool consider_endpoints = false;
  // Whether a kernel's density is divided by its deviations, as it must be for a density of
  // integral 1. Optuna before 3.5 does not (its issue 5109), which favours wide kernels.
  bool divide_by_deviation = true;
};

// Mixture of products of normal distributions on the unit cube, one component per point and a prior
// component that covers the cube (centre 0.5, deviation 1). In linear dimensions the normals are
// truncated to [0, 1]; in periodic ones they are wrapped around and the prior is uniform.
// Immutable and thread-safe. Rules of weights, centres and deviations: Optuna 3.1.0; the periodic
// kernel is ours.
class ParzenEstimator {
 public:
  // @param points  In [0, 1]; may be empty. In one dimension, sorted points are cheapest.
  // @param weights  One per point, > 0; scaled together with the prior's to sum 1.
  // @param periodic  One per dimension.
  ParzenEstimator(const Columns& points,
                  const std::vector<double>& weights,
                  const std::vector<bool>& periodic,
                  const ParzenOptions& options);

  // Points drawn from the mixture.
  Columns Sample(Random& random, std::size_t count) const;

  // Density at each point, to 1e-12 of it. One exponential per point and kernel, in vector code.
  std::vector<double> Densities(const Columns& points) const;

 private:
  void Normalize(const std::vector<double>& weights, const ParzenOptions& options);

  std::vector<KernelAxis> axes_;
  std::vector<double> cumulative_weights_;
  // Weight over the integral of the unnormalised kernel; the prior is the last.
  std::vector<double> coefficients_;
};

}  // namespace ridgeline
