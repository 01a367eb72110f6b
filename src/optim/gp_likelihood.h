// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <vector>

#include "optim/gaussian_process.h"

namespace ridgeline {

// Marginal likelihood of a Gaussian process (see there) as a function of its hyper-parameters.
class GpLikelihood {
 public:
  // @param points  Columns in the unit cube.
  // @param targets  Standardised values at the points.
  GpLikelihood(const Eigen::MatrixXd& points,
               const Eigen::VectorXd& targets,
               const std::vector<bool>& periodic);

  // Natural logarithm of the likelihood, Rasmussen and Williams 2006, eq. 2.30; its gradient by the
  // hyper-parameters if not null, eq. 5.9. -infinity if the matrix is not positive definite.
  // O(n^3): n^3 multiplications with the gradient, a third of that without.
  double operator()(const GpHyper& hyper, Eigen::VectorXd* gradient) const;

 private:
  Eigen::VectorXd targets_;
  // Squared distances along each dimension (columns) of the pairs of points (i, j), i > j, i
  // fastest.
  Eigen::MatrixXd squares_;
};

}  // namespace ridgeline
