// SPDX-License-Identifier: Apache-2.0
#include "study/explore.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "base/parallel.h"

namespace ridgeline {
namespace {

struct Tried {
  ViewAngles angles;  // offsets from the prior's
  double log_ratio = -std::numeric_limits<double>::infinity();
};

constexpr std::array<double ViewAngles::*, 3> kAngles = {
    &ViewAngles::heading_deg, &ViewAngles::pitch_deg, &ViewAngles::roll_deg};
constexpr std::size_t kStarts = 3;
constexpr double kFirstStepDeg = 1.0;
constexpr double kLastStepDeg = 0.125;

// Positions of a fixed spacing, symmetric about the centre.
int StepsEachWay(double half_range, double spacing) {
  return static_cast<int>(std::floor(half_range / spacing + 1e-9));
}

template <typename Evaluate>
Tried Improved(Tried best, const ViewAngles& half_ranges, const Evaluate& evaluate) {
  for (double step = kFirstStepDeg; step >= kLastStepDeg; step *= 0.5) {
    for (bool moved = true; moved;) {
      moved = false;
      for (const auto angle : kAngles) {
        for (const double sign : {1.0, -1.0}) {
          ViewAngles candidate = best.angles;
          candidate.*angle =
              std::clamp(candidate.*angle + sign * step, -(half_ranges.*angle), half_ranges.*angle);
          if (candidate.*angle == best.angles.*angle) continue;
          const double log_ratio = evaluate(candidate);
          if (log_ratio <= best.log_ratio) continue;
          best = {candidate, log_ratio};
          moved = true;
        }
      }
    }
  }
  return best;
}

}  // namespace

ExploredMap Explore(const PoseScorer& scorer, const ExploreOptions& options, int threads) {
  const PoseSpace& space = scorer.space();
  const PoseSpaceOptions& ranges = space.ranges();
  const int east_steps = StepsEachWay(ranges.east_m, options.spacing_m);
  const int north_steps = StepsEachWay(ranges.north_m, options.spacing_m);
  const ViewAngles half_ranges{ranges.heading_deg,
                               ranges.pitch_deg > 0.0 ? ranges.pitch_deg : options.tilt_deg,
                               ranges.roll_deg > 0.0 ? ranges.roll_deg : options.tilt_deg};
  const PanoramaRange panorama = scorer.RangeAround(space.center_angles(), half_ranges);
  const int heading_steps =
      static_cast<int>(std::ceil(ranges.heading_deg / options.heading_step_deg - 1e-9));

  ExploredMap explored;
  EnergyMap& map = explored.map;
  map.columns = 2 * east_steps + 1;
  map.rows = 2 * north_steps + 1;
  map.spacing_m = options.spacing_m;
  map.first = scorer.scene().model().origin_in_world.head<2>() + space.center() -
              options.spacing_m * Eigen::Vector2d(east_steps, north_steps);
  const std::size_t cells = static_cast<std::size_t>(map.columns) * map.rows;
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
  map.energies.assign(cells, kNan);
  map.headings_deg.assign(cells, kNan);
  explored.pitch_deg.assign(cells, kNan);
  explored.roll_deg.assign(cells, kNan);

  ParallelFor(cells, threads, [&](std::size_t cell) {
    const int column = static_cast<int>(cell) % map.columns;
    const int row = static_cast<int>(cell) / map.columns;
    const auto position = space.PositionAt(
        (column - east_steps) * options.spacing_m, (row - north_steps) * options.spacing_m, 0.0);
    if (!position) return;
    PoseScorer::Look look(scorer);
    look.From(*position, panorama);
    const auto evaluate = [&](const ViewAngles& a) {
      const PoseSpace::Offset offset{0.0, 0.0, 0.0, a.heading_deg, a.pitch_deg, a.roll_deg};
      return look.PictureLogRatio({CamFromWorld(space.AnglesAt(offset)), *position});
    };
    std::vector<Tried> tried;
    for (int h = -heading_steps; h <= heading_steps; ++h) {
      const ViewAngles angles{
          heading_steps == 0 ? 0.0 : ranges.heading_deg * h / heading_steps, 0.0, 0.0};
      tried.push_back({angles, evaluate(angles)});
    }
    std::stable_sort(tried.begin(), tried.end(), [](const Tried& a, const Tried& b) {
      return a.log_ratio > b.log_ratio;
    });
    Tried best = tried.front();
    for (std::size_t i = 0; i < std::min(kStarts, tried.size()); ++i) {
      const Tried improved = Improved(tried[i], half_ranges, evaluate);
      if (improved.log_ratio > best.log_ratio) best = improved;
    }
    const ViewAngles angles = space.AnglesAt(
        {0.0, 0.0, 0.0, best.angles.heading_deg, best.angles.pitch_deg, best.angles.roll_deg});
    map.energies[cell] = static_cast<float>(Score::EnergyOf(best.log_ratio));
    map.headings_deg[cell] = static_cast<float>(angles.heading_deg);
    explored.pitch_deg[cell] = static_cast<float>(angles.pitch_deg);
    explored.roll_deg[cell] = static_cast<float>(angles.roll_deg);
  });
  return explored;
}

}  // namespace ridgeline
