// SPDX-License-Identifier: Apache-2.0
#include "track/bell_mixture.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace ridgeline {
namespace {

constexpr std::size_t kMostBells = 6;
constexpr double kLeastBellMass = 0.003;
// Poses within this reach of the heaviest are covered by one bell.
constexpr double kReachM = 1.5;
constexpr double kReachDeg = 3.0;
// Proposals are wider than what they are fitted to, so that its edges are tried too.
constexpr double kWiden = 1.4;
constexpr double kFloorM = 0.03;
constexpr double kFloorDeg = 0.03;

PoseCovariance Floor() {
  PoseVector floor;
  floor << kFloorM, kFloorM, kFloorM, kFloorDeg, kFloorDeg, kFloorDeg;
  return floor.cwiseAbs2().asDiagonal();
}

}  // namespace

BellMixture::BellMixture(const std::vector<PoseBell>& bells) {
  double total = 0.0;
  for (const PoseBell& bell : bells) total += bell.mass;
  const double norm = std::pow(2.0 * std::numbers::pi, -3.0);
  for (const PoseBell& bell : bells) {
    const Eigen::LLT<PoseCovariance> llt(bell.covariance);
    Part part;
    part.mean = bell.mean;
    part.root = llt.matrixL();
    part.inverse_root = part.root.triangularView<Eigen::Lower>().solve(PoseCovariance::Identity());
    part.share = total > 0.0 ? bell.mass / total : 1.0 / static_cast<double>(bells.size());
    part.factor = norm * part.inverse_root.diagonal().prod();
    parts_.push_back(part);
  }
}

double BellMixture::Density(const PoseVector& v) const {
  double density = 0.0;
  for (const Part& part : parts_) {
    const double square = (part.inverse_root * DifferenceOf(v, part.mean)).squaredNorm();
    density += part.share * part.factor * std::exp(-0.5 * square);
  }
  return density;
}

PoseVector BellMixture::Draw(Random& random) const {
  double left = random.Uniform();
  std::size_t i = 0;
  while (i + 1 < parts_.size() && left > parts_[i].share) left -= parts_[i++].share;
  PoseVector normal;
  for (int k = 0; k < 6; ++k) normal(k) = random.Normal();
  PoseVector v = parts_[i].mean + parts_[i].root * normal;
  v(3) = WrapHeadingDeg(v(3));
  return v;
}

PoseBell BellAround(const std::vector<PoseVector>& poses,
                    const std::vector<double>& weights,
                    const PoseVector& middle,
                    double reach_m,
                    double reach_deg) {
  PoseBell bell;
  PoseVector sum = PoseVector::Zero();
  PoseCovariance squares = PoseCovariance::Zero();
  for (std::size_t i = 0; i < poses.size(); ++i) {
    if (!IsNear(poses[i], middle, reach_m, reach_deg)) continue;
    const PoseVector d = DifferenceOf(poses[i], middle);
    bell.mass += weights[i];
    sum += weights[i] * d;
    squares += weights[i] * d * d.transpose();
  }
  bell.mean = middle;
  bell.covariance.setZero();
  if (bell.mass <= 0.0) return bell;
  const PoseVector shift = sum / bell.mass;
  bell.mean += shift;
  bell.mean(3) = WrapHeadingDeg(bell.mean(3));
  bell.covariance = squares / bell.mass - shift * shift.transpose();
  return bell;
}

std::vector<PoseBell> FitBells(const std::vector<PoseVector>& poses,
                               const std::vector<double>& weights,
                               const PoseCovariance& broad) {
  std::vector<double> left = weights;
  std::vector<PoseBell> bells;
  double covered = 0.0;
  while (bells.size() < kMostBells && covered < 1.0 - kLeastBellMass) {
    const auto top = std::max_element(left.begin(), left.end());
    if (*top <= 0.0) break;
    const PoseVector middle = poses[static_cast<std::size_t>(top - left.begin())];
    PoseBell bell = BellAround(poses, left, middle, kReachM, kReachDeg);
    double squares = 0.0;
    for (std::size_t i = 0; i < poses.size(); ++i) {
      if (left[i] <= 0.0 || !IsNear(poses[i], middle, kReachM, kReachDeg)) continue;
      squares += left[i] * left[i];
      left[i] = 0.0;
    }
    const double effective = bell.mass * bell.mass / squares;
    covered += bell.mass;
    bell.covariance = kWiden * bell.covariance + broad / (1.0 + effective) + Floor();
    bells.push_back(bell);
    if (bell.mass < kLeastBellMass) break;
  }
  std::stable_sort(bells.begin(), bells.end(), [](const PoseBell& a, const PoseBell& b) {
    return a.mass > b.mass;
  });
  return bells;
}

}  // namespace ridgeline
