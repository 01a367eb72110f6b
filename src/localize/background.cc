// SPDX-License-Identifier: Apache-2.0
#include "localize/background.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "base/parallel.h"

namespace ridgeline {
namespace {

// Beyond the box by this much: nothing of its answers is seen from there in the same way.
constexpr double kBeyondM = 25.0;
// Places lie within this of a corner of a building, in each direction.
constexpr double kBesideBuildingsM = 30.0;
constexpr int kTriesPerPlace = 40;

// Of Halton's low-discrepancy sequence (1960).
double Halton(std::uint64_t index, std::uint64_t base) {
  double value = 0.0;
  double digit = 1.0;
  for (; index > 0; index /= base) {
    digit /= static_cast<double>(base);
    value += digit * static_cast<double>(index % base);
  }
  return value;
}

std::vector<PoseSpace> SpacesOutside(const PoseScorer& scorer, int count) {
  const PoseSpace& space = scorer.space();
  const std::vector<Eigen::Vector3d>& vertices = scorer.scene().model().vertices;
  const Eigen::Vector2d beyond(space.ranges().east_m + kBeyondM, space.ranges().north_m + kBeyondM);
  std::vector<PoseSpace> spaces;
  const std::uint64_t tries = static_cast<std::uint64_t>(count) * kTriesPerPlace;
  for (std::uint64_t i = 1; i <= tries && static_cast<int>(spaces.size()) < count; ++i) {
    const auto vertex = static_cast<std::size_t>(Halton(i, 2) * static_cast<double>(vertices.size()));
    const Eigen::Vector2d aside(Halton(i, 3) - 0.5, Halton(i, 5) - 0.5);
    const Eigen::Vector2d offset =
        vertices[vertex].head<2>() + 2.0 * kBesideBuildingsM * aside - space.center();
    if ((offset.cwiseAbs().array() <= beyond.array()).all()) continue;
    const std::optional<double> height = space.SameHeightAboveGround(offset.x(), offset.y());
    if (!height || !space.PositionAt(offset.x(), offset.y(), *height)) continue;
    spaces.push_back(space.MovedTo({.east_m = offset.x(),
                                    .north_m = offset.y(),
                                    .height_m = *height,
                                    .heading_deg = 360.0 * Halton(i, 7)}));
  }
  return spaces;
}

// At the middle of a space.
std::vector<PoseSpace::Offset> OffsetsIn(const PoseSpace& space,
                                         std::span<const Tilt> tilts,
                                         double heading_step_deg) {
  const double range = space.ranges().heading_deg;
  const int steps = static_cast<int>(std::floor(range / heading_step_deg));
  std::vector<PoseSpace::Offset> offsets;
  for (int i = -steps; i <= steps; ++i) {
    if (range >= 180.0 && i == steps) break;
    for (const Tilt& tilt : tilts) {
      offsets.push_back({.heading_deg = heading_step_deg * i,
                         .pitch_deg = tilt.pitch_deg - space.center_angles().pitch_deg,
                         .roll_deg = tilt.roll_deg - space.center_angles().roll_deg});
    }
  }
  return offsets;
}

}  // namespace

std::vector<BackgroundPose> BackgroundOf(const PoseScorer& scorer,
                                         std::span<const Tilt> tilts,
                                         double heading_step_deg,
                                         int count,
                                         int threads,
                                         std::uint64_t& evaluations) {
  std::vector<BackgroundPose> poses;
  for (const PoseSpace& space : SpacesOutside(scorer, count)) poses.push_back({space, {}});
  ParallelFor(poses.size(), threads, [&](std::size_t i) {
    const PoseScorer there = scorer.In(poses[i].space);
    const std::vector<PoseSpace::Offset> offsets =
        OffsetsIn(poses[i].space, tilts, heading_step_deg);
    PoseScorer::Look look(there);
    look.From(*poses[i].space.PositionAt(0.0, 0.0, 0.0), there.RangeOver(offsets));
    const std::span<const double> log_ratios = look.LogRatios(there.OrientationsOf(offsets));
    const auto best = std::max_element(log_ratios.begin(), log_ratios.end());
    poses[i].best = {offsets[static_cast<std::size_t>(best - log_ratios.begin())], *best};
  });
  if (!poses.empty()) {
    evaluations += poses.size() * OffsetsIn(poses.front().space, tilts, heading_step_deg).size();
  }
  std::erase_if(poses, [](const BackgroundPose& p) { return !std::isfinite(p.best.log_ratio); });
  std::stable_sort(poses.begin(), poses.end(), [](const auto& x, const auto& y) {
    return x.best.log_ratio > y.best.log_ratio;
  });
  return poses;
}

}  // namespace ridgeline
