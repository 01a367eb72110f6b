// SPDX-License-Identifier: Apache-2.0
#include "optim/box_bfgs.h"

#include <algorithm>
#include <cmath>

namespace ridgeline {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int kHalvings = 20;
constexpr double kArmijo = 1e-4;

// 1 where a variable may move: not at a bound with the descent leading outside.
VectorXd FreeVariables(const VectorXd& x,
                       const VectorXd& descent,
                       const VectorXd& lower,
                       const VectorXd& upper) {
  VectorXd free = VectorXd::Ones(x.size());
  for (Eigen::Index i = 0; i < x.size(); ++i) {
    if ((x[i] <= lower[i] && descent[i] < 0.0) || (x[i] >= upper[i] && descent[i] > 0.0)) {
      free[i] = 0.0;
    }
  }
  return free;
}

void UpdateInverseHessian(const VectorXd& step, const VectorXd& change, MatrixXd& inverse) {
  const double curvature = step.dot(change);
  if (curvature <= 1e-12 * step.norm() * change.norm()) return;
  const VectorXd product = inverse * change;
  const double scale = (curvature + change.dot(product)) / (curvature * curvature);
  inverse += scale * step * step.transpose() -
             (product * step.transpose() + step * product.transpose()) / curvature;
}

}  // namespace

BoxBfgsResult MinimizeInBox(const SmoothFunction& function,
                            const VectorXd& start,
                            const VectorXd& lower,
                            const VectorXd& upper,
                            const BoxBfgsOptions& options) {
  VectorXd x = start.cwiseMax(lower).cwiseMin(upper);
  VectorXd gradient(x.size());
  double value = function(x, &gradient);
  // The first step is a fraction of the box; later ones have the scale of the function.
  const double reach = 0.1 * (upper - lower).norm();
  MatrixXd inverse = MatrixXd::Identity(x.size(), x.size());
  bool scaled = false;
  for (int iteration = 0; iteration < options.max_iterations; ++iteration) {
    const VectorXd free = FreeVariables(x, -gradient, lower, upper);
    const VectorXd projected = gradient.cwiseProduct(free);
    if (projected.cwiseAbs().maxCoeff() < options.tolerance) break;
    VectorXd direction = -free.cwiseProduct(inverse * projected);
    if (direction.dot(projected) >= 0.0) direction = -projected;
    double length = scaled ? 1.0 : std::min(1.0, reach / direction.norm());

    VectorXd next_x;
    VectorXd next_gradient(x.size());
    double next = value;
    bool found = false;
    for (int halving = 0; halving < kHalvings && !found; ++halving, length *= 0.5) {
      next_x = (x + length * direction).cwiseMax(lower).cwiseMin(upper);
      next = function(next_x, &next_gradient);
      found = next <= value + kArmijo * gradient.dot(next_x - x);
    }
    if (!found) break;
    const VectorXd step = next_x - x;
    const VectorXd change = next_gradient - gradient;
    if (!scaled && step.dot(change) > 0.0) inverse *= step.dot(change) / change.squaredNorm();
    scaled = true;
    UpdateInverseHessian(step, change, inverse);
    const double gain = value - next;
    x = next_x;
    gradient = next_gradient;
    value = next;
    if (gain <= options.tolerance * (1.0 + std::abs(value))) break;
  }
  return {x, value};
}

}  // namespace ridgeline
