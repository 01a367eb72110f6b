// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <vector>

#include "base/random.h"
#include "track/pose_filter.h"
#include "track/pose_vector.h"

namespace ridgeline {

// A sum of normal distributions of poses, to draw from.
class BellMixture {
 public:
  BellMixture() = default;
  // Their masses count relative to each other.
  explicit BellMixture(const std::vector<PoseBell>& bells);

  // [1 / (m^3 deg^3)]; 0 without bells.
  double Density(const PoseVector& v) const;
  PoseVector Draw(Random& random) const;

 private:
  struct Part {
    PoseVector mean;
    PoseCovariance root;          // lower Cholesky factor
    PoseCovariance inverse_root;  // of the covariance's lower factor
    double share = 0.0;
    double factor = 0.0;  // density at the mean
  };
  std::vector<Part> parts_;
};

// Mean, covariance and mass of the weighted poses within a reach of a middle; without any, an empty
// bell there.
PoseBell BellAround(const std::vector<PoseVector>& poses,
                    const std::vector<double>& weights,
                    const PoseVector& middle,
                    double reach_m,
                    double reach_deg);

// Bells that cover weighted poses, the heaviest first, at most six. `broad` is mixed in where few
// poses carry the weight.
std::vector<PoseBell> FitBells(const std::vector<PoseVector>& poses,
                               const std::vector<double>& weights,
                               const PoseCovariance& broad);

}  // namespace ridgeline
