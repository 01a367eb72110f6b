// SPDX-License-Identifier: Apache-2.0
#include "localize/pose_volume.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>

#include "base/parallel.h"

namespace ridgeline {
namespace {

constexpr float kNone = -std::numeric_limits<float>::infinity();

// Symmetric offsets that reach both ends of the half-range, at most `step` apart.
std::vector<double> Offsets(double half_range, double step) {
  if (half_range <= 0.0) return {0.0};
  const int steps = static_cast<int>(std::ceil(half_range / step - 1e-9));
  std::vector<double> offsets;
  for (int i = -steps; i <= steps; ++i) offsets.push_back(half_range * i / steps);
  return offsets;
}

// The whole circle has no end: its last offset would be its first again.
std::vector<double> HeadingOffsets(double half_range_deg, double step_deg) {
  std::vector<double> offsets = Offsets(half_range_deg, step_deg);
  if (half_range_deg >= 180.0) offsets.pop_back();
  return offsets;
}

}  // namespace

double SpacingOf(const PoseSpaceOptions& ranges, const MapOptions& options) {
  double spacing = options.spacing_m;
  const auto positions = [&] {
    return Offsets(ranges.east_m, spacing).size() * Offsets(ranges.north_m, spacing).size() *
           Offsets(ranges.height_m, spacing).size();
  };
  while (positions() > static_cast<std::size_t>(options.max_positions)) spacing *= 1.1;
  return spacing;
}

PoseSpace::Offset PoseVolume::OffsetOf(std::size_t index, const ViewAngles& center) const {
  const std::size_t tilt = index % tilts.size();
  index /= tilts.size();
  const std::size_t heading = index % heading_deg.size();
  index /= heading_deg.size();
  const std::size_t east = index % east_m.size();
  index /= east_m.size();
  const std::size_t north = index % north_m.size();
  return {east_m[east],
          north_m[north],
          height_m[index / north_m.size()],
          heading_deg[heading],
          tilts[tilt].pitch_deg - center.pitch_deg,
          tilts[tilt].roll_deg - center.roll_deg};
}

PoseVolume ComputeVolume(const PoseScorer& scorer,
                         std::span<const Tilt> tilts,
                         const MapOptions& options,
                         int threads) {
  const PoseSpace& space = scorer.space();
  const PoseSpaceOptions& ranges = space.ranges();
  PoseVolume volume;
  const double spacing_m = SpacingOf(ranges, options);
  volume.east_m = Offsets(ranges.east_m, spacing_m);
  volume.north_m = Offsets(ranges.north_m, spacing_m);
  volume.height_m = Offsets(ranges.height_m, spacing_m);
  volume.heading_deg = HeadingOffsets(ranges.heading_deg, options.heading_step_deg);
  volume.tilts.assign(tilts.begin(), tilts.end());
  const std::size_t positions =
      volume.east_m.size() * volume.north_m.size() * volume.height_m.size();
  volume.log_ratios.assign(positions * volume.orientations(), kNone);

  // The panorama must hold every tilt.
  ViewAngles half_ranges{ranges.heading_deg, 0.0, 0.0};
  for (const Tilt& tilt : tilts) {
    half_ranges.pitch_deg =
        std::max(half_ranges.pitch_deg, std::abs(tilt.pitch_deg - space.center_angles().pitch_deg));
    half_ranges.roll_deg =
        std::max(half_ranges.roll_deg, std::abs(tilt.roll_deg - space.center_angles().roll_deg));
  }
  const PanoramaRange range = scorer.RangeAround(space.center_angles(), half_ranges);
  std::vector<PoseSpace::Offset> offsets;
  for (std::size_t i = 0; i < volume.orientations(); ++i) {
    offsets.push_back(volume.OffsetOf(i, space.center_angles()));
  }
  const Orientations orientations = scorer.OrientationsOf(offsets);
  std::vector<std::uint8_t> admissible(positions, 0);
  ParallelFor(positions, threads, [&](std::size_t p) {
    const std::size_t first = p * volume.orientations();
    const PoseSpace::Offset offset = volume.OffsetOf(first, space.center_angles());
    const auto position = space.PositionAt(offset.east_m, offset.north_m, offset.height_m);
    if (!position) return;
    admissible[p] = 1;
    PoseScorer::Look look(scorer);
    look.From(*position, range);
    const std::span<const double> log_ratios = look.LogRatios(orientations);
    std::transform(log_ratios.begin(),
                   log_ratios.end(),
                   volume.log_ratios.begin() + static_cast<std::ptrdiff_t>(first),
                   [](double log_ratio) { return static_cast<float>(log_ratio); });
  });
  volume.admissible_positions =
      std::accumulate(admissible.begin(), admissible.end(), std::uint64_t{0});
  volume.evaluations = volume.admissible_positions * volume.orientations();
  return volume;
}

std::vector<ScoredPose> FindModes(const PoseVolume& volume,
                                  const PoseSpace& space,
                                  const MapOptions& options) {
  std::vector<std::size_t> order(volume.log_ratios.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t x, std::size_t y) {
    return volume.log_ratios[x] > volume.log_ratios[y];
  });
  // Neighbours on a wide grid are one mode.
  const double spacing_m = volume.east_m.size() > 1 ? volume.east_m[1] - volume.east_m[0] : 0.0;
  const double separation_m = std::max(options.mode_separation_m, 1.2 * spacing_m);
  std::vector<ScoredPose> modes;
  for (const std::size_t index : order) {
    if (volume.log_ratios[index] == kNone || static_cast<int>(modes.size()) == options.modes) break;
    const PoseSpace::Offset o = volume.OffsetOf(index, space.center_angles());
    const bool is_near = std::any_of(modes.begin(), modes.end(), [&](const ScoredPose& mode) {
      const PoseSpace::Offset& m = mode.offset;
      const double distance =
          Eigen::Vector3d(o.east_m - m.east_m, o.north_m - m.north_m, o.height_m - m.height_m)
              .norm();
      return distance < separation_m &&
             std::abs(HeadingDifferenceDeg(o.heading_deg, m.heading_deg)) <
                 options.mode_separation_deg;
    });
    if (!is_near) modes.push_back({o, volume.log_ratios[index]});
  }
  return modes;
}

EnergyMap MapOf(const PoseVolume& volume, const PoseSpace& space, const CityModel& model) {
  EnergyMap map;
  map.columns = static_cast<int>(volume.east_m.size());
  map.rows = static_cast<int>(volume.north_m.size());
  map.first = model.origin_in_world.head<2>() + space.center() +
              Eigen::Vector2d(volume.east_m.front(), volume.north_m.front());
  map.spacing_m = map.columns > 1 ? volume.east_m[1] - volume.east_m[0]
                  : map.rows > 1  ? volume.north_m[1] - volume.north_m[0]
                                  : 1.0;
  const std::size_t cells = static_cast<std::size_t>(map.columns) * map.rows;
  std::vector<std::size_t> best(cells, 0);
  std::vector<float> log_ratios(cells, kNone);
  for (std::size_t i = 0; i < volume.log_ratios.size(); ++i) {
    const std::size_t cell = i / volume.orientations() % cells;
    if (volume.log_ratios[i] <= log_ratios[cell]) continue;
    log_ratios[cell] = volume.log_ratios[i];
    best[cell] = i;
  }
  for (std::size_t cell = 0; cell < cells; ++cell) {
    const bool known = log_ratios[cell] != kNone;
    const float nan = std::numeric_limits<float>::quiet_NaN();
    map.energies.push_back(known ? static_cast<float>(Score::EnergyOf(log_ratios[cell])) : nan);
    map.headings_deg.push_back(
        known ? static_cast<float>(
                    space.AnglesAt(volume.OffsetOf(best[cell], space.center_angles())).heading_deg)
              : nan);
  }
  return map;
}

}  // namespace ridgeline
