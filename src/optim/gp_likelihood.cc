// SPDX-License-Identifier: Apache-2.0
#include "optim/gp_likelihood.h"

#include <Eigen/Cholesky>
#include <cmath>
#include <limits>
#include <numbers>

namespace ridgeline {
namespace {

using Eigen::ArrayXd;
using Eigen::Index;
using Eigen::Lower;
using Eigen::MatrixXd;
using Eigen::VectorXd;

// Blocks up to this size are worked on directly.
constexpr Index kSmall = 24;

// The inverse of a lower triangle, in its place; by halves, so that most of it is products.
void InvertLower(Eigen::Ref<MatrixXd> lower) {
  const Index n = lower.rows();
  if (n <= kSmall) {
    const MatrixXd factor = lower;
    lower.setIdentity();
    factor.triangularView<Lower>().solveInPlace(lower);
    return;
  }
  const Index half = n / 2;
  Eigen::Ref<MatrixXd> first = lower.topLeftCorner(half, half);
  Eigen::Ref<MatrixXd> second = lower.bottomRightCorner(n - half, n - half);
  InvertLower(first);
  InvertLower(second);
  const MatrixXd product = lower.bottomLeftCorner(n - half, half) * first.triangularView<Lower>();
  lower.bottomLeftCorner(n - half, half).noalias() = -(second.triangularView<Lower>() * product);
}

// The lower half of L^T L in the place of L.
void MultiplyByTranspose(Eigen::Ref<MatrixXd> lower) {
  const Index n = lower.rows();
  if (n <= kSmall) {
    const MatrixXd factor = lower.triangularView<Lower>();
    lower.noalias() = factor.transpose() * factor;
    return;
  }
  const Index half = n / 2;
  Eigen::Ref<MatrixXd> first = lower.topLeftCorner(half, half);
  Eigen::Ref<MatrixXd> second = lower.bottomRightCorner(n - half, n - half);
  Eigen::Ref<MatrixXd> below = lower.bottomLeftCorner(n - half, half);
  MultiplyByTranspose(first);
  first.selfadjointView<Lower>().rankUpdate(below.transpose());
  below = second.triangularView<Lower>().transpose() * MatrixXd(below);
  MultiplyByTranspose(second);
}

}  // namespace

GpLikelihood::GpLikelihood(const MatrixXd& points,
                           const VectorXd& targets,
                           const std::vector<bool>& periodic)
    : targets_(targets) {
  const Index n = points.cols();
  squares_.resize(n * (n - 1) / 2, points.rows());
  for (Index d = 0; d < points.rows(); ++d) {
    Index pair = 0;
    for (Index j = 0; j < n; ++j) {
      for (Index i = j + 1; i < n; ++i) {
        const double way = GaussianProcess::Distance(points(d, i), points(d, j), periodic[d]);
        squares_(pair++, d) = way * way;
      }
    }
  }
}

double GpLikelihood::operator()(const GpHyper& hyper, VectorXd* gradient) const {
  const Index n = targets_.size();
  const Index dimension = squares_.cols();
  const VectorXd inverse_squares = (-2.0 * hyper.head(dimension)).array().exp();
  const double signal = std::exp(hyper[dimension]);
  const double noise = std::exp(hyper[dimension + 1]);
  const ArrayXd r = (5.0 * (squares_ * inverse_squares)).array().sqrt();
  const ArrayXd decay = signal * (-r).exp();
  const ArrayXd covariances = (1.0 + r + r * r / 3.0) * decay;

  MatrixXd matrix(n, n);
  for (Index j = 0, pair = 0; j < n; pair += n - 1 - j, ++j) {
    matrix(j, j) = signal + noise;
    matrix.col(j).tail(n - 1 - j) = covariances.segment(pair, n - 1 - j);
  }
  Eigen::LLT<Eigen::Ref<MatrixXd>> factor(matrix);
  if (factor.info() != Eigen::Success) {
    if (gradient != nullptr) gradient->setZero(hyper.size());
    return -std::numeric_limits<double>::infinity();
  }
  const VectorXd weights = factor.solve(targets_);
  const double half_log_determinant = matrix.diagonal().array().log().sum();
  const double value = -0.5 * targets_.dot(weights) - half_log_determinant -
                       0.5 * static_cast<double>(n) * std::log(2.0 * std::numbers::pi);
  if (gradient == nullptr) return value;

  // Half the trace of (weights weights^T - inverse) times the derivative of the matrix. Each pair
  // stands for two elements, which takes the half away.
  InvertLower(matrix);
  MultiplyByTranspose(matrix);
  ArrayXd outer(covariances.size());
  for (Index j = 0, pair = 0; j < n; pair += n - 1 - j, ++j) {
    outer.segment(pair, n - 1 - j) =
        weights[j] * weights.tail(n - 1 - j) - matrix.col(j).tail(n - 1 - j);
  }
  const double diagonal = 0.5 * (weights.squaredNorm() - matrix.trace());
  const VectorXd slopes = -5.0 / 6.0 * (1.0 + r) * decay * outer;
  gradient->resize(hyper.size());
  gradient->head(dimension) = -2.0 * inverse_squares.cwiseProduct(squares_.transpose() * slopes);
  (*gradient)[dimension] = (outer * covariances).sum() + diagonal * signal;
  (*gradient)[dimension + 1] = diagonal * noise;
  return value;
}

}  // namespace ridgeline
