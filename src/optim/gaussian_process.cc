// SPDX-License-Identifier: Apache-2.0
#include "optim/gaussian_process.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace ridgeline {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kSmallestVariance = 1e-12;

// Signed distance along one dimension, before the division by the length, and its derivative.
struct Way {
  double distance = 0.0;
  double slope = 1.0;
};

Way WayBetween(double from, double to, bool periodic) {
  if (!periodic) return {to - from, 1.0};
  const double angle = std::numbers::pi * (to - from);
  return {std::sin(angle) / std::numbers::pi, std::cos(angle)};
}

// Matern 5/2 of the scaled distance squared, and its derivative by that.
double Matern(double square) {
  const double r = std::sqrt(5.0 * square);
  return (1.0 + r + r * r / 3.0) * std::exp(-r);
}
double MaternSlope(double square) {
  const double r = std::sqrt(5.0 * square);
  return -5.0 / 6.0 * (1.0 + r) * std::exp(-r);
}

double SquaredDistance(const double* a,
                       const double* b,
                       const VectorXd& inverse_lengths,
                       const std::vector<bool>& periodic) {
  double square = 0.0;
  for (Index d = 0; d < inverse_lengths.size(); ++d) {
    const double scaled = WayBetween(a[d], b[d], periodic[d]).distance * inverse_lengths[d];
    square += scaled * scaled;
  }
  return square;
}

}  // namespace

GaussianProcess::GaussianProcess(const std::vector<bool>& periodic) : periodic_(periodic) {}

VectorXd GaussianProcess::Covariances(const VectorXd& point) const {
  VectorXd covariances(count_);
  for (std::size_t i = 0; i < count_; ++i) {
    covariances[i] =
        signal_ *
        Matern(SquaredDistance(points_.col(i).data(), point.data(), inverse_lengths_, periodic_));
  }
  return covariances;
}

void GaussianProcess::Reset(const MatrixXd& points, const GpHyper& hyper) {
  const Index dimension = points.rows();
  inverse_lengths_ = (-hyper.head(dimension)).array().exp();
  signal_ = std::exp(hyper[dimension]);
  noise_ = std::exp(hyper[dimension + 1]);
  const Index n = points.cols();
  const Index capacity = n + std::max<Index>(32, n / 4);
  points_.resize(dimension, capacity);
  points_.leftCols(n) = points;
  factor_.setZero(capacity, capacity);
  for (Index j = 0; j < n; ++j) {
    for (Index i = j; i < n; ++i) {
      factor_(i, j) =
          signal_ * Matern(SquaredDistance(
                        points_.col(i).data(), points_.col(j).data(), inverse_lengths_, periodic_));
    }
    factor_(j, j) += noise_;
  }
  Eigen::Ref<MatrixXd> block = factor_.topLeftCorner(n, n);
  Eigen::LLT<Eigen::Ref<MatrixXd>> factored(block);
  count_ = static_cast<std::size_t>(n);
}

void GaussianProcess::Append(const VectorXd& point) {
  const Index n = static_cast<Index>(count_);
  if (n == points_.cols()) {
    const Index capacity = n + std::max<Index>(32, n / 4);
    points_.conservativeResize(Eigen::NoChange, capacity);
    factor_.conservativeResize(capacity, capacity);
  }
  VectorXd row = Covariances(point);
  factor_.topLeftCorner(n, n).triangularView<Eigen::Lower>().solveInPlace(row);
  points_.col(n) = point;
  factor_.row(n).head(n) = row.transpose();
  factor_(n, n) = std::sqrt(std::max(kSmallestVariance, signal_ + noise_ - row.squaredNorm()));
  ++count_;
}

void GaussianProcess::SetTargets(const VectorXd& targets) {
  const Index n = static_cast<Index>(count_);
  weights_ = targets;
  const auto lower = factor_.topLeftCorner(n, n).triangularView<Eigen::Lower>();
  lower.solveInPlace(weights_);
  lower.transpose().solveInPlace(weights_);
}

GaussianProcess::Prediction GaussianProcess::Predict(const VectorXd& point,
                                                     VectorXd* d_mean,
                                                     VectorXd* d_deviation) const {
  const Index n = static_cast<Index>(count_);
  const VectorXd covariances = Covariances(point);
  const auto lower = factor_.topLeftCorner(n, n).triangularView<Eigen::Lower>();
  VectorXd solved = covariances;
  lower.solveInPlace(solved);
  const double variance = std::max(kSmallestVariance, signal_ - solved.squaredNorm());
  const Prediction prediction{covariances.dot(weights_), std::sqrt(variance)};
  if (d_mean == nullptr) return prediction;

  lower.transpose().solveInPlace(solved);
  d_mean->setZero(point.size());
  d_deviation->setZero(point.size());
  for (Index i = 0; i < n; ++i) {
    const double* at = points_.col(i).data();
    const double slope =
        2.0 * signal_ * MaternSlope(SquaredDistance(at, point.data(), inverse_lengths_, periodic_));
    for (Index d = 0; d < point.size(); ++d) {
      const Way way = WayBetween(at[d], point[d], periodic_[d]);
      const double change =
          slope * way.distance * way.slope * inverse_lengths_[d] * inverse_lengths_[d];
      (*d_mean)[d] += weights_[i] * change;
      (*d_deviation)[d] -= solved[i] * change / prediction.deviation;
    }
  }
  return prediction;
}

std::vector<GaussianProcess::Prediction> GaussianProcess::PredictAll(const MatrixXd& points) const {
  const Index n = static_cast<Index>(count_);
  MatrixXd covariances(n, points.cols());
  for (Index j = 0; j < points.cols(); ++j) covariances.col(j) = Covariances(points.col(j));
  const VectorXd means = covariances.transpose() * weights_;
  factor_.topLeftCorner(n, n).triangularView<Eigen::Lower>().solveInPlace(covariances);
  std::vector<Prediction> predictions(points.cols());
  for (Index j = 0; j < points.cols(); ++j) {
    const double variance = std::max(kSmallestVariance, signal_ - covariances.col(j).squaredNorm());
    predictions[j] = {means[j], std::sqrt(variance)};
  }
  return predictions;
}

double GaussianProcess::Distance(double from, double to, bool periodic) {
  return WayBetween(from, to, periodic).distance;
}

}  // namespace ridgeline
