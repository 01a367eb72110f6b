// SPDX-License-Identifier: Apache-2.0
#include "optim/parzen.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>
#include <numeric>

#include "optim/kernel_sum.h"

namespace ridgeline {
namespace {

constexpr double kScottMagnitude = 0.2;
constexpr double kSmallestSigma = 1e-12;
// A normal distribution has nothing in double precision beyond this many deviations.
constexpr double kReach = 9.0;

// Probability below -x, x >= 0.
double Tail(double x) { return x > kReach ? 0.0 : 0.5 * std::erfc(x / std::numbers::sqrt2); }

// The gap rule for points in rising order. A line has the prior's centre among them and, for the
// outermost, one neighbour only (or the bound); a circle has no ends and no prior's centre.
std::vector<double> NeighbourSigmas(const std::vector<double>& sorted,
                                    bool periodic,
                                    bool consider_endpoints) {
  const std::size_t n = sorted.size();
  std::vector<double> sigmas(n, 1.0);
  for (std::size_t i = 0; i < n; ++i) {
    double left = i > 0 ? sorted[i] - sorted[i - 1] : sorted[i];
    double right = i + 1 < n ? sorted[i + 1] - sorted[i] : 1.0 - sorted[i];
    if (periodic) {
      if (i == 0) left = sorted[i] + 1.0 - sorted[n - 1];
      if (i + 1 == n) right = sorted[0] + 1.0 - sorted[i];
    } else if (!consider_endpoints && n >= 2) {
      if (i == 0) left = 0.0;
      if (i + 1 == n) right = 0.0;
    }
    sigmas[i] = std::max(left, right);
  }
  return sigmas;
}

// Sigmas in the order of the points.
std::vector<double> UnsortedNeighbourSigmas(const std::vector<double>& points,
                                            bool periodic,
                                            bool consider_endpoints) {
  std::vector<std::size_t> order(points.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto less = [&](std::size_t a, std::size_t b) { return points[a] < points[b]; };
  if (!std::is_sorted(points.begin(), points.end())) {
    std::stable_sort(order.begin(), order.end(), less);
  }
  // The prior's centre stands between the points, behind its equals.
  const std::size_t prior =
      std::partition_point(
          order.begin(), order.end(), [&](std::size_t i) { return points[i] <= 0.5; }) -
      order.begin();
  std::vector<double> sorted;
  sorted.reserve(points.size() + 1);
  for (const std::size_t i : order) sorted.push_back(points[i]);
  if (!periodic) sorted.insert(sorted.begin() + prior, 0.5);
  const std::vector<double> sorted_sigmas = NeighbourSigmas(sorted, periodic, consider_endpoints);
  std::vector<double> sigmas(points.size());
  for (std::size_t k = 0; k < order.size(); ++k) {
    sigmas[order[k]] = sorted_sigmas[k + (!periodic && k >= prior ? 1 : 0)];
  }
  return sigmas;
}

}  // namespace

ParzenEstimator::ParzenEstimator(const Columns& points,
                                 const std::vector<double>& weights,
                                 const std::vector<bool>& periodic,
                                 const ParzenOptions& options) {
  assert(points.size() == periodic.size() && !points.empty());
  assert(options.rule == BandwidthRule::kScott || points.size() == 1);
  for (std::size_t d = 0; d < points.size(); ++d) {
    dimensions_.push_back(MakeDimension(points[d], periodic[d], points.size(), options));
  }
  Normalize(weights, options);
}

ParzenEstimator::Dimension ParzenEstimator::MakeDimension(const std::vector<double>& points,
                                                          bool periodic,
                                                          std::size_t dimensions,
                                                          const ParzenOptions& options) {
  const std::size_t n = points.size();
  Dimension result;
  result.periodic = periodic;
  result.mu = points;
  if (options.rule == BandwidthRule::kNeighbours) {
    result.sigma = UnsortedNeighbourSigmas(points, periodic, options.consider_endpoints);
  } else {
    const double count = static_cast<double>(std::max<std::size_t>(n, 1));
    result.sigma.assign(n, kScottMagnitude * std::pow(count, -1.0 / (dimensions + 4.0)));
  }
  const double kernels = static_cast<double>(n + 1);
  const double smallest =
      options.magic_clip ? 1.0 / std::min(100.0, 1.0 + kernels) : kSmallestSigma;
  for (double& sigma : result.sigma) sigma = std::clamp(sigma, smallest, 1.0);
  result.mu.push_back(0.5);
  result.sigma.push_back(1.0);
  for (const double sigma : result.sigma) {
    result.inverse_sigma.push_back(1.0 / sigma);
    result.images.push_back(periodic ? static_cast<int>(kReach * sigma + 0.5) : 0);
  }
  if (periodic) {
    // Uniform: every place is at no distance.
    result.inverse_sigma.back() = 0.0;
    result.images.back() = 0;
  }
  return result;
}

void ParzenEstimator::Normalize(const std::vector<double>& weights, const ParzenOptions& options) {
  coefficients_ = weights;
  coefficients_.push_back(options.prior_weight);
  const double sum = std::accumulate(coefficients_.begin(), coefficients_.end(), 0.0);
  for (double& weight : coefficients_) weight /= sum;
  cumulative_weights_.resize(coefficients_.size());
  std::partial_sum(coefficients_.begin(), coefficients_.end(), cumulative_weights_.begin());

  const double inverse_root = 1.0 / std::sqrt(2.0 * std::numbers::pi);
  for (const Dimension& dimension : dimensions_) {
    for (std::size_t k = 0; k < coefficients_.size(); ++k) {
      const double scale = dimension.inverse_sigma[k];
      if (scale == 0.0) continue;
      double mass = 1.0;
      if (!dimension.periodic) {
        mass -= Tail(dimension.mu[k] * scale) + Tail((1.0 - dimension.mu[k]) * scale);
      }
      coefficients_[k] *= inverse_root * (options.divide_by_deviation ? scale : 1.0) / mass;
      has_images_ |= dimension.images[k] > 0;
    }
  }
}

double ParzenEstimator::SampleCoordinate(const Dimension& dimension,
                                         std::size_t kernel,
                                         Random& random) const {
  const double mu = dimension.mu[kernel];
  const double scale = dimension.inverse_sigma[kernel];
  if (scale == 0.0) return random.Uniform();
  if (dimension.periodic) {
    const double x = mu + random.Normal() * dimension.sigma[kernel];
    return x - std::floor(x);
  }
  const double below = Tail(mu * scale);
  const double mass = 1.0 - below - Tail((1.0 - mu) * scale);
  const double p = std::clamp(below + random.Uniform() * mass, 1e-300, 1.0 - 1e-16);
  return std::clamp(mu + NormalQuantile(p) * dimension.sigma[kernel], 0.0, 1.0);
}

Columns ParzenEstimator::Sample(Random& random, std::size_t count) const {
  Columns samples(dimensions_.size(), std::vector<double>(count));
  for (std::size_t i = 0; i < count; ++i) {
    const auto it = std::upper_bound(
        cumulative_weights_.begin(), cumulative_weights_.end() - 1, random.Uniform());
    const std::size_t kernel = it - cumulative_weights_.begin();
    for (std::size_t d = 0; d < dimensions_.size(); ++d) {
      samples[d][i] = SampleCoordinate(dimensions_[d], kernel, random);
    }
  }
  return samples;
}

std::vector<double> ParzenEstimator::LogDensities(const Columns& points) const {
  const std::size_t count = points[0].size();
  std::vector<double> squares(coefficients_.size());
  std::vector<double> factors;
  std::vector<double> result(count);
  for (std::size_t i = 0; i < count; ++i) {
    std::fill(squares.begin(), squares.end(), 0.0);
    if (has_images_) factors = coefficients_;
    for (std::size_t d = 0; d < dimensions_.size(); ++d) {
      if (dimensions_[d].periodic) {
        AddPeriodic(dimensions_[d], points[d][i], squares, factors);
      } else {
        AddLinear(dimensions_[d], points[d][i], squares);
      }
    }
    const std::vector<double>& weights = has_images_ ? factors : coefficients_;
    result[i] = std::log(KernelSum(squares.data(), weights.data(), squares.size()));
  }
  return result;
}

void ParzenEstimator::AddLinear(const Dimension& dimension,
                                double x,
                                std::vector<double>& squares) {
  const double* mu = dimension.mu.data();
  const double* scale = dimension.inverse_sigma.data();
  double* square = squares.data();
  for (std::size_t k = 0; k < squares.size(); ++k) {
    const double z = (x - mu[k]) * scale[k];
    square[k] += z * z;
  }
}

void ParzenEstimator::AddPeriodic(const Dimension& dimension,
                                  double x,
                                  std::vector<double>& squares,
                                  std::vector<double>& factors) {
  for (std::size_t k = 0; k < squares.size(); ++k) {
    const double way = std::abs(x - dimension.mu[k]);
    const double scale = dimension.inverse_sigma[k];
    const double nearest = std::min(way, 1.0 - way) * scale;
    const int images = dimension.images[k];
    if (images == 0) {
      squares[k] += nearest * nearest;
      continue;
    }
    double sum = 0.0;
    for (int image = -images; image <= images; ++image) {
      const double z = nearest + image * scale;
      sum += std::exp(-0.5 * z * z);
    }
    factors[k] *= sum;
  }
}

}  // namespace ridgeline
