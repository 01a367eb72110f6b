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

constexpr float kNoRatio = -std::numeric_limits<float>::infinity();

// Symmetric offsets that reach both ends of the half-range, at most `step` apart.
std::vector<double> Offsets(double half_range, double step) {
  if (half_range <= 0.0) return {0.0};
  const int steps = static_cast<int>(std::ceil(half_range / step - 1e-9));
  std::vector<double> offsets;
  for (int i = -steps; i <= steps; ++i) offsets.push_back(half_range * i / steps);
  return offsets;
}

// A height that is known to less than the spacing is left to the refinement.
std::vector<double> HeightOffsets(double half_range, double step) {
  return half_range < step ? std::vector<double>{0.0} : Offsets(half_range, step);
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
           HeightOffsets(ranges.height_m, spacing).size();
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

PoseVolume EmptyVolume(const PoseSpace& space,
                       std::span<const Tilt> tilts,
                       const MapOptions& options) {
  const PoseSpaceOptions& ranges = space.ranges();
  PoseVolume volume;
  const double spacing_m = SpacingOf(ranges, options);
  volume.east_m = Offsets(ranges.east_m, spacing_m);
  volume.north_m = Offsets(ranges.north_m, spacing_m);
  volume.height_m = HeightOffsets(ranges.height_m, spacing_m);
  volume.heading_deg = HeadingOffsets(ranges.heading_deg, options.heading_step_deg);
  volume.tilts.assign(tilts.begin(), tilts.end());
  volume.log_ratios.assign(volume.positions() * volume.orientations(), kNoRatio);
  return volume;
}

void FillVolume(const PoseScorer& scorer,
                std::span<const std::vector<std::uint32_t>> orientations,
                int threads,
                PoseVolume& volume) {
  const PoseSpace& space = scorer.space();
  const ViewAngles& center = space.center_angles();
  std::vector<std::uint8_t> admissible(volume.positions(), 0);
  ParallelFor(volume.positions(), threads, [&](std::size_t p) {
    if (orientations[p].empty()) return;
    const std::size_t first = p * volume.orientations();
    std::vector<PoseSpace::Offset> offsets;
    for (const std::uint32_t i : orientations[p]) {
      offsets.push_back(volume.OffsetOf(first + i, center));
    }
    const PoseSpace::Offset& place = offsets.front();
    const auto position = space.PositionAt(place.east_m, place.north_m, place.height_m);
    if (!position) return;
    admissible[p] = 1;
    PoseScorer::Look look(scorer);
    look.From(*position, scorer.RangeOver(offsets));
    const std::span<const double> log_ratios = look.LogRatios(scorer.OrientationsOf(offsets));
    for (std::size_t k = 0; k < offsets.size(); ++k) {
      volume.log_ratios[first + orientations[p][k]] = static_cast<float>(log_ratios[k]);
    }
  });
  for (std::size_t p = 0; p < admissible.size(); ++p) {
    if (admissible[p] != 0) volume.evaluations += orientations[p].size();
  }
}

PoseVolume ComputeVolume(const PoseScorer& scorer,
                         std::span<const Tilt> tilts,
                         const MapOptions& options,
                         int threads) {
  PoseVolume volume = EmptyVolume(scorer.space(), tilts, options);
  std::vector<std::uint32_t> all(volume.orientations());
  std::iota(all.begin(), all.end(), 0u);
  FillVolume(
      scorer, std::vector<std::vector<std::uint32_t>>(volume.positions(), all), threads, volume);
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
    if (volume.log_ratios[index] == kNoRatio) break;
    if (static_cast<int>(modes.size()) == options.modes) break;
    const PoseSpace::Offset o = volume.OffsetOf(index, space.center_angles());
    const bool is_near = std::any_of(modes.begin(), modes.end(), [&](const ScoredPose& mode) {
      return DistanceM(o, mode.offset) < separation_m &&
             std::abs(HeadingDifferenceDeg(o.heading_deg, mode.offset.heading_deg)) <
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
  std::vector<float> log_ratios(cells, kNoRatio);
  for (std::size_t i = 0; i < volume.log_ratios.size(); ++i) {
    const std::size_t cell = i / volume.orientations() % cells;
    if (volume.log_ratios[i] <= log_ratios[cell]) continue;
    log_ratios[cell] = volume.log_ratios[i];
    best[cell] = i;
  }
  for (std::size_t cell = 0; cell < cells; ++cell) {
    const bool known = log_ratios[cell] != kNoRatio;
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
