// SPDX-License-Identifier: Apache-2.0
#include "report/map_shapes.h"

#include <Eigen/Eigenvalues>
#include <cmath>
#include <numbers>

namespace ridgeline {

using Eigen::Vector2d;

std::vector<Vector2d> EllipseOutline(const Vector2d& center, const Eigen::Matrix2d& covariance) {
  constexpr double kChiSquare95 = 5.991464547107979;  // -2 ln 0.05
  constexpr int kSides = 48;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> solver(covariance);
  const Vector2d axes = (kChiSquare95 * solver.eigenvalues().cwiseMax(0.0)).cwiseSqrt();
  std::vector<Vector2d> outline;
  for (int i = 0; i <= kSides; ++i) {
    const double turn = 2.0 * std::numbers::pi * (i % kSides) / kSides;
    outline.push_back(center + solver.eigenvectors() *
                                   Vector2d(axes.x() * std::cos(turn), axes.y() * std::sin(turn)));
  }
  return outline;
}

std::vector<Vector2d> ViewCone(const ReportPose& pose, double hfov_deg, double reach_m) {
  constexpr int kSides = 12;
  const Vector2d center = pose.position.head<2>();
  std::vector<Vector2d> outline = {center};
  for (int i = 0; i <= kSides; ++i) {
    const double azimuth = (pose.heading_deg + hfov_deg * (static_cast<double>(i) / kSides - 0.5)) *
                           std::numbers::pi / 180.0;
    outline.push_back(center + reach_m * Vector2d(std::sin(azimuth), std::cos(azimuth)));
  }
  outline.push_back(center);
  return outline;
}

}  // namespace ridgeline
