// SPDX-License-Identifier: Apache-2.0
#include "track/skyline_certainty.h"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>

#include "base/angle.h"
#include "score/sky_score.h"

namespace ridgeline {
namespace {

constexpr int kVariables = 5;  // heading, pitch, roll [deg], east, north [m]
using Vector = Eigen::Matrix<double, kVariables, 1>;
using Matrix = Eigen::Matrix<double, kVariables, kVariables>;
// Steps of the differences.
constexpr std::array<double, kVariables> kSteps{1.0, 0.5, 1.0, 0.3, 0.3};
// Most that one column can tell of a step [px at 640], as the distance limits it.
constexpr double kMostPx = 60.0;
// Columns to either side that a change is spread over.
constexpr double kSpreadDeg = 1.5;
// Least deviation that a column is taken to have [px at 640].
constexpr double kLeastDeviationPx = 1.0;
// Deviations come by the roof, not by the column: so many pixels (at 640) count as one. Found on
// synthetic walks, where the errors are known.
constexpr double kAlikePx = 80.0;

Pose Moved(const Pose& pose, int variable, double step) {
  ViewAngles angles = ViewAnglesOf(pose.cam_from_world);
  if (variable == 0) angles.heading_deg += step;
  if (variable == 1) angles.pitch_deg += step;
  if (variable == 2) angles.roll_deg += step;
  Eigen::Vector3d center = pose.center_in_world;
  if (variable >= 3) center[variable - 3] += step;
  return {CamFromWorld(angles), center};
}

}  // namespace

double HeadingSigmaDeg(
    const SkylineL1& real,
    const std::function<std::vector<Eigen::Vector3f>(const Eigen::Vector3d&)>& look,
    const Pose& pose,
    double distance_px,
    const SkylinePrior& prior) {
  const PinholeCamera& camera = real.camera();
  const double px_scale = kSkylineReferenceWidthPx / camera.width;
  const std::vector<Eigen::Vector3f> here = look(pose.center_in_world);
  const auto rows_at = [&](const Pose& at, std::vector<float>& rows) {
    rows.resize(real.rows().size());
    const bool moved = at.center_in_world != pose.center_in_world;
    SkylineRows(moved ? look(at.center_in_world) : here,
                camera,
                at.cam_from_world.toRotationMatrix().cast<float>(),
                rows);
    // Beyond the picture's borders nothing is seen of it.
    for (float& row : rows) row = std::clamp(row, 0.0f, static_cast<float>(camera.height));
  };
  std::array<std::vector<float>, kVariables> lower, upper;
  for (int v = 0; v < kVariables; ++v) {
    const auto k = static_cast<std::size_t>(v);
    rows_at(Moved(pose, v, -0.5 * kSteps[k]), lower[k]);
    rows_at(Moved(pose, v, 0.5 * kSteps[k]), upper[k]);
  }
  Matrix information = Matrix::Zero();
  const double deviation = std::max(kLeastDeviationPx, distance_px);
  const double weight = px_scale / kAlikePx / (deviation * deviation);
  // Changes of the columns, spread over their neighbours: a corner that moves aside changes other
  // columns than one that moves twice as far, and yet both tell the same.
  std::array<std::vector<double>, kVariables> changes;
  const int columns = camera.width;
  const int reach = static_cast<int>(std::ceil(kSpreadDeg * kRadPerDeg * camera.fx));
  for (int v = 0; v < kVariables; ++v) {
    const auto k = static_cast<std::size_t>(v);
    std::vector<double> sums(static_cast<std::size_t>(columns) + 1, 0.0);
    for (std::size_t c = 0; c < real.rows().size(); ++c) {
      const double step_px = (upper[k][c] - lower[k][c]) * px_scale;
      // NaN: the virtual skyline does not reach the column.
      const double change = std::isnan(step_px) ? 0.0 : std::clamp(step_px, -kMostPx, kMostPx);
      sums[c + 1] = sums[c] + change / kSteps[k];
    }
    for (int c = 0; c < columns; ++c) {
      const int first = std::max(0, c - reach), end = std::min(columns, c + reach + 1);
      changes[k].push_back(
          (sums[static_cast<std::size_t>(end)] - sums[static_cast<std::size_t>(first)]) /
          (2 * reach + 1));
    }
  }
  for (std::size_t c = 0; c < real.rows().size(); ++c) {
    Vector change;
    for (int v = 0; v < kVariables; ++v) change[v] = changes[static_cast<std::size_t>(v)][c];
    information += weight * real.weights()[c] * change * change.transpose();
  }
  information.diagonal().head<3>() +=
      Eigen::Vector3d(prior.heading_sigma_deg, prior.tilt_sigma_deg, prior.tilt_sigma_deg)
          .cwiseAbs2()
          .cwiseInverse();
  const double position_variance = prior.position_sigma_m * prior.position_sigma_m;
  if (prior.position_matched) {
    information.diagonal().tail<2>().array() += 1.0 / position_variance;
    return std::sqrt(information.inverse()(0, 0));
  }
  const Eigen::Matrix3d of_angles = information.topLeftCorner<3, 3>().inverse();
  // What the angles give way by if the position is off.
  const Eigen::Matrix<double, 3, 2> give = of_angles * information.topRightCorner<3, 2>();
  return std::sqrt(of_angles(0, 0) + position_variance * give.row(0).squaredNorm());
}

}  // namespace ridgeline
