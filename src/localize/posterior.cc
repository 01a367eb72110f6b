// SPDX-License-Identifier: Apache-2.0
#include "localize/posterior.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace ridgeline {
namespace {

constexpr double kNearM = 2.0;
constexpr double kNearDeg = 2.0;

struct Sample {
  PoseSpace::Offset offset;
  double log_ratio = 0.0;
};

using Vector6 = Eigen::Matrix<double, 6, 1>;
using Matrix6 = Eigen::Matrix<double, 6, 6>;

Vector6 Difference(const PoseSpace::Offset& a, const PoseSpace::Offset& b) {
  Vector6 d;
  d << a.east_m - b.east_m, a.north_m - b.north_m, a.height_m - b.height_m,
      HeadingDifferenceDeg(a.heading_deg, b.heading_deg), a.pitch_deg - b.pitch_deg,
      a.roll_deg - b.roll_deg;
  return d;
}

Posterior FromSamples(const std::vector<Sample>& samples,
                      const PoseSpace::Offset& best,
                      const ConfidenceOptions& options) {
  double highest = samples.front().log_ratio;
  for (const Sample& sample : samples) highest = std::max(highest, sample.log_ratio);
  double total = 0.0;
  double near = 0.0;
  Matrix6 moments = Matrix6::Zero();
  for (const Sample& sample : samples) {
    const double weight = std::exp((sample.log_ratio - highest) / options.temperature);
    total += weight;
    const double distance = DistanceM(sample.offset, best);
    const double angle = AngleDeg(sample.offset, best);
    if (distance <= kNearM && angle <= kNearDeg) near += weight;
    const Vector6 d = Difference(sample.offset, best);
    moments += weight * d * d.transpose();
  }
  Posterior posterior;
  posterior.mass = near / total;
  Vector6 floors;
  floors << Eigen::Vector3d::Constant(options.floor_m), Eigen::Vector3d::Constant(options.floor_deg);
  const Matrix6 floor = floors.cwiseAbs2().asDiagonal();
  posterior.spread.covariance = moments / total + floor;
  posterior.spread.position_covariance = posterior.spread.covariance.topLeftCorner<2, 2>();
  posterior.spread.heading_sigma_deg = std::sqrt(posterior.spread.covariance(3, 3));
  return posterior;
}

}  // namespace

Posterior PosteriorOf(const PoseVolume& volume,
                      std::span<const ScoredPose> modes,
                      const PoseSpace& space,
                      const ConfidenceOptions& options) {
  // A cell of the volume stands beside the peak of its mode; it is lifted by what the refinement
  // gained there, falling off over the size of a cell.
  const double radius_m =
      volume.east_m.size() > 1 ? volume.east_m[1] - volume.east_m[0] : 1.0;
  std::vector<Sample> samples;
  for (const ScoredPose& mode : modes) samples.push_back({mode.offset, mode.log_ratio});
  for (std::size_t i = 0; i < volume.log_ratios.size(); ++i) {
    if (!std::isfinite(volume.log_ratios[i])) continue;
    const PoseSpace::Offset offset = volume.OffsetOf(i, space.center_angles());
    const bool is_mode = std::any_of(modes.begin(), modes.end(), [&](const ScoredPose& mode) {
      return DistanceM(offset, mode.offset) < 0.5 * radius_m &&
             AngleDeg(offset, mode.offset) < 0.5;
    });
    if (!is_mode) samples.push_back({offset, volume.log_ratios[i]});
  }
  return FromSamples(samples, modes.front().offset, options);
}

Posterior PosteriorOf(std::span<const ScoredPose> modes, const ConfidenceOptions& options) {
  std::vector<Sample> samples;
  for (const ScoredPose& mode : modes) samples.push_back({mode.offset, mode.log_ratio});
  return FromSamples(samples, modes.front().offset, options);
}

}  // namespace ridgeline
