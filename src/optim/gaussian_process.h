// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <vector>

namespace ridgeline {

// Hyper-parameters as natural logarithms, in the order: one length per dimension (in units of the
// cube), variance of the signal, variance of the noise.
using GpHyper = Eigen::VectorXd;

// Gaussian process on the unit cube with the Matern 5/2 kernel, one length per dimension
// (Rasmussen and Williams 2006, eq. 4.17 and algorithm 2.1). Across a periodic dimension the
// distance is the chord of a circle of circumference 1, which keeps the kernel positive definite.
class GaussianProcess {
 public:
  explicit GaussianProcess(const std::vector<bool>& periodic);

  std::size_t size() const { return count_; }

  // Takes points (columns) and their hyper-parameters. O(n^3).
  void Reset(const Eigen::MatrixXd& points, const GpHyper& hyper);
  // Adds a point to the Cholesky factor. O(n^2).
  void Append(const Eigen::VectorXd& point);
  // Removes the last points.
  void Shrink(std::size_t count) { count_ = count; }
  // Values at all points, standardised by the caller. O(n^2).
  void SetTargets(const Eigen::VectorXd& targets);

  struct Prediction {
    double mean = 0.0;
    double deviation = 0.0;  // of the signal, without the noise; > 0
  };
  // O(n^2); gradients by the point where not null.
  Prediction Predict(const Eigen::VectorXd& point,
                     Eigen::VectorXd* d_mean,
                     Eigen::VectorXd* d_deviation) const;
  // Of many points (columns) at once, faster than one by one.
  std::vector<Prediction> PredictAll(const Eigen::MatrixXd& points) const;

  // Signed distance along one dimension.
  static double Distance(double from, double to, bool periodic);

 private:
  Eigen::VectorXd Covariances(const Eigen::VectorXd& point) const;

  std::vector<bool> periodic_;
  Eigen::VectorXd inverse_lengths_;
  double signal_ = 1.0;
  double noise_ = 0.0;
  // Capacity grows ahead of count_.
  std::size_t count_ = 0;
  Eigen::MatrixXd points_;
  Eigen::MatrixXd factor_;
  Eigen::VectorXd weights_;
};

}  // namespace ridgeline
