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

struct Place {
  Eigen::Vector3d position;  // local
  double heading_deg;        // offset: the middle of those to look at
};

std::vector<Place> PlacesOutside(const PoseScorer& scorer, int count) {
  const PoseSpace& space = scorer.space();
  const std::vector<Eigen::Vector3d>& vertices = scorer.scene().model().vertices;
  const Eigen::Vector2d beyond(space.ranges().east_m + kBeyondM, space.ranges().north_m + kBeyondM);
  std::vector<Place> places;
  const std::uint64_t tries = static_cast<std::uint64_t>(count) * kTriesPerPlace;
  for (std::uint64_t i = 1; i <= tries && static_cast<int>(places.size()) < count; ++i) {
    const auto vertex = static_cast<std::size_t>(Halton(i, 2) * static_cast<double>(vertices.size()));
    const Eigen::Vector2d aside(Halton(i, 3) - 0.5, Halton(i, 5) - 0.5);
    const Eigen::Vector2d offset =
        vertices[vertex].head<2>() + 2.0 * kBesideBuildingsM * aside - space.center();
    if ((offset.cwiseAbs().array() <= beyond.array()).all()) continue;
    const std::optional<double> height = space.SameHeightAboveGround(offset.x(), offset.y());
    if (!height) continue;
    const auto position = space.PositionAt(offset.x(), offset.y(), *height);
    if (!position) continue;
    places.push_back({*position, 360.0 * Halton(i, 7)});
  }
  return places;
}

std::vector<PoseSpace::Offset> OffsetsAt(const Place& place,
                                         const PoseSpace& space,
                                         std::span<const Tilt> tilts,
                                         double heading_step_deg) {
  const double range = space.ranges().heading_deg;
  const int steps = static_cast<int>(std::floor(range / heading_step_deg));
  std::vector<PoseSpace::Offset> offsets;
  for (int i = -steps; i <= steps; ++i) {
    if (range >= 180.0 && i == steps) break;
    for (const Tilt& tilt : tilts) {
      offsets.push_back({.heading_deg = place.heading_deg + heading_step_deg * i,
                         .pitch_deg = tilt.pitch_deg - space.center_angles().pitch_deg,
                         .roll_deg = tilt.roll_deg - space.center_angles().roll_deg});
    }
  }
  return offsets;
}

}  // namespace

Background BackgroundOf(const PoseScorer& scorer,
                        std::span<const Tilt> tilts,
                        double heading_step_deg,
                        int count,
                        int threads) {
  const std::vector<Place> places = PlacesOutside(scorer, count);
  std::vector<double> highest(places.size());
  std::vector<std::uint64_t> evaluations(places.size());
  ParallelFor(places.size(), threads, [&](std::size_t i) {
    const std::vector<PoseSpace::Offset> offsets =
        OffsetsAt(places[i], scorer.space(), tilts, heading_step_deg);
    PoseScorer::Look look(scorer);
    look.From(places[i].position, scorer.RangeOver(offsets));
    const std::span<const double> log_ratios = look.LogRatios(scorer.OrientationsOf(offsets));
    highest[i] = *std::max_element(log_ratios.begin(), log_ratios.end());
    evaluations[i] = offsets.size();
  });
  Background background;
  for (std::size_t i = 0; i < places.size(); ++i) {
    background.evaluations += evaluations[i];
    if (std::isfinite(highest[i])) background.log_ratios.push_back(highest[i]);
  }
  return background;
}

}  // namespace ridgeline
