// SPDX-License-Identifier: Apache-2.0
#include "optim/parzen.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>
#include <numeric>
#include <span>

namespace ridgeline {
namespace {

constexpr double kScottMagnitude = 0.2;
constexpr double kSmallestSigma = 1e-12;
// A normal distribution has nothing in double precision beyond this many deviations.
constexpr double kReach = 9.0;

// Probability below -x, x >= 0.
double Tail(double x) { return x > kReach ? 0.0 : 0.5 * std::erfc(x / std::numbers::sqrt2); }

// The gap rule for the point `i` of points in rising order: the wider of the gaps to its
// neighbours. A line has the prior's centre among them, before the point `prior`, and for the
// outermost one neighbour only (or the bound); a circle has no ends and no prior's centre.
struct GapRule {
  std::span<const double> sorted;
  bool periodic = false;
  bool consider_endpoints = false;
  std::size_t prior = 0;

  double Sigma(std::size_t i) const {
    const std::size_t n = sorted.size();
    double left = i > 0 ? sorted[i] - sorted[i - 1] : 0.0;
    double right = i + 1 < n ? sorted[i + 1] - sorted[i] : 0.0;
    if (periodic) {
      if (i == 0) left = sorted[0] + 1.0 - sorted[n - 1];
      if (i + 1 == n) right = sorted[0] + 1.0 - sorted[i];
      return std::max(left, right);
    }
    if (i == prior) left = sorted[i] - 0.5;
    if (i + 1 == prior) right = 0.5 - sorted[i];
    if (consider_endpoints && i == 0 && prior != 0) left = sorted[0];
    if (consider_endpoints && i + 1 == n && prior != n) right = 1.0 - sorted[i];
    return std::max(left, right);
  }
};

// In the order of the points, which need not rise.
void SetNeighbourSigmas(const std::vector<double>& points,
                        bool consider_endpoints,
                        KernelAxis& axis) {
  std::vector<std::size_t> order;
  std::vector<double> copy;
  if (!std::is_sorted(points.begin(), points.end())) {
    order.resize(points.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
      return points[a] < points[b];
    });
    for (const std::size_t i : order) copy.push_back(points[i]);
  }
  const std::vector<double>& sorted = order.empty() ? points : copy;
  // The prior's centre stands behind its equals.
  const std::size_t prior = std::upper_bound(sorted.begin(), sorted.end(), 0.5) - sorted.begin();
  const GapRule rule{sorted, axis.periodic, consider_endpoints, prior};
  for (std::size_t i = 0; i < sorted.size(); ++i) {
    axis.kernels[order.empty() ? i : order[i]].sigma = rule.Sigma(i);
  }
}

// What follows from a kernel's centre and deviation.
void Complete(AxisKernel& kernel, bool periodic) {
  const double inverse = 1.0 / kernel.sigma;
  kernel.scale = kBinaryScale * inverse;
  if (periodic) {
    kernel.images = static_cast<int>(kReach * kernel.sigma + 0.5);
  } else {
    kernel.below = Tail(kernel.mu * inverse);
    kernel.mass = 1.0 - kernel.below - Tail((1.0 - kernel.mu) * inverse);
  }
}

KernelAxis MakeAxis(const std::vector<double>& points,
                    bool periodic,
                    std::size_t dimensions,
                    const ParzenOptions& options) {
  KernelAxis axis;
  axis.periodic = periodic;
  axis.kernels.reserve(points.size() + 1);
  axis.kernels.resize(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) axis.kernels[i].mu = points[i];
  if (options.rule == BandwidthRule::kNeighbours) {
    SetNeighbourSigmas(points, options.consider_endpoints, axis);
  } else {
    const double count = static_cast<double>(std::max<std::size_t>(points.size(), 1));
    const double sigma = kScottMagnitude * std::pow(count, -1.0 / (dimensions + 4.0));
    for (AxisKernel& kernel : axis.kernels) kernel.sigma = sigma;
  }
  const double smallest = options.magic_clip
                              ? 1.0 / std::min(100.0, 2.0 + static_cast<double>(points.size()))
                              : kSmallestSigma;
  for (AxisKernel& kernel : axis.kernels) {
    kernel.sigma = std::clamp(kernel.sigma, smallest, 1.0);
    Complete(kernel, periodic);
  }
  AxisKernel prior;
  if (!periodic) Complete(prior, periodic);
  axis.kernels.push_back(prior);
  return axis;
}

double SampleCoordinate(const AxisKernel& kernel, bool periodic, Random& random) {
  if (kernel.scale == 0.0) return random.Uniform();
  if (periodic) {
    const double x = kernel.mu + random.Normal() * kernel.sigma;
    return x - std::floor(x);
  }
  const double p = std::clamp(kernel.below + random.Uniform() * kernel.mass, 1e-300, 1.0 - 1e-16);
  return std::clamp(kernel.mu + NormalQuantile(p) * kernel.sigma, 0.0, 1.0);
}

}  // namespace

ParzenEstimator::ParzenEstimator(const Columns& points,
                                 const std::vector<double>& weights,
                                 const std::vector<bool>& periodic,
                                 const ParzenOptions& options) {
  assert(points.size() == periodic.size() && !points.empty());
  assert(options.rule == BandwidthRule::kScott || points.size() == 1);
  axes_.reserve(points.size());
  for (std::size_t d = 0; d < points.size(); ++d) {
    axes_.push_back(MakeAxis(points[d], periodic[d], points.size(), options));
  }
  Normalize(weights, options);
}

void ParzenEstimator::Normalize(const std::vector<double>& weights, const ParzenOptions& options) {
  coefficients_.reserve(weights.size() + 1);
  coefficients_ = weights;
  coefficients_.push_back(options.prior_weight);
  const double sum = std::accumulate(coefficients_.begin(), coefficients_.end(), 0.0);
  for (double& weight : coefficients_) weight /= sum;
  cumulative_weights_.resize(coefficients_.size());
  std::partial_sum(coefficients_.begin(), coefficients_.end(), cumulative_weights_.begin());

  const double inverse_root = 1.0 / std::sqrt(2.0 * std::numbers::pi);
  for (const KernelAxis& axis : axes_) {
    for (std::size_t k = 0; k < coefficients_.size(); ++k) {
      const AxisKernel& kernel = axis.kernels[k];
      if (kernel.scale == 0.0) continue;
      const double width = options.divide_by_deviation ? kernel.sigma : 1.0;
      coefficients_[k] *= inverse_root / (kernel.mass * width);
    }
  }
}

Columns ParzenEstimator::Sample(Random& random, std::size_t count) const {
  Columns samples(axes_.size(), std::vector<double>(count));
  for (std::size_t i = 0; i < count; ++i) {
    const auto it = std::upper_bound(
        cumulative_weights_.begin(), cumulative_weights_.end() - 1, random.Uniform());
    const std::size_t kernel = it - cumulative_weights_.begin();
    for (std::size_t d = 0; d < axes_.size(); ++d) {
      samples[d][i] = SampleCoordinate(axes_[d].kernels[kernel], axes_[d].periodic, random);
    }
  }
  return samples;
}

std::vector<double> ParzenEstimator::Densities(const Columns& points) const {
  return KernelSums(axes_, coefficients_, points);
}

}  // namespace ridgeline
