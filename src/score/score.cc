// SPDX-License-Identifier: Apache-2.0
#include "score/score.h"

#include <algorithm>
#include <cmath>

namespace ridgeline {

namespace {

constexpr double kScale = 10.0;

}  // namespace

void Score::LogRatios(const PositionView& view,
                      std::span<const Pose> poses,
                      Workspace& workspace,
                      std::span<double> log_ratios) const {
  for (std::size_t i = 0; i < poses.size(); ++i) {
    log_ratios[i] = LogRatio(view, poses[i], workspace);
  }
}

std::unique_ptr<Score> Score::Tolerant(double /*factor*/) const { return nullptr; }

std::unique_ptr<Score> Score::ForTilts(std::span<const Eigen::Matrix3f> /*cam_from_level*/) const {
  return nullptr;
}

double Score::EnergyOf(double log_ratio) {
  return std::isnan(log_ratio) ? 1.0 : 1.0 / (1.0 + std::exp(log_ratio / kScale));
}

double Score::LogRatioOf(double energy) {
  constexpr double kLeast = 1e-12;  // of two perfect poses none is infinitely better
  const double e = std::max(energy, kLeast);
  return kScale * std::log((1.0 - e) / e);
}

}  // namespace ridgeline
