// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "localize/gravity.h"
#include "localize/localization.h"
#include "localize/localizer_options.h"
#include "localize/pose_scorer.h"
#include "localize/pose_space.h"

namespace ridgeline {

// Log likelihood ratios on a dense grid of the search box.
struct PoseVolume {
  // Offsets from the prior; a fixed parameter has one, 0.
  std::vector<double> east_m;
  std::vector<double> north_m;
  std::vector<double> height_m;
  std::vector<double> heading_deg;
  std::vector<Tilt> tilts;  // absolute
  // By height, north, east, heading, tilt (the last fastest); -infinity: not admissible or nothing
  // of the model in view.
  std::vector<float> log_ratios;
  std::uint64_t evaluations = 0;
  // The highest log ratio of the first, tolerant look of ComputeVolumeCoarseToFine().
  double highest_first = 0.0;

  std::size_t orientations() const { return heading_deg.size() * tilts.size(); }
  std::size_t positions() const { return east_m.size() * north_m.size() * height_m.size(); }
  PoseSpace::Offset OffsetOf(std::size_t index, const ViewAngles& center) const;
};

// Spacing [m] of the grid in all free directions: the options', or wider so that there are no more
// than max_positions.
double SpacingOf(const PoseSpaceOptions& ranges, const MapOptions& options);

// The grid with nothing looked at.
PoseVolume EmptyVolume(const PoseSpace& space,
                       std::span<const Tilt> tilts,
                       const MapOptions& options);

// Looks at some of the poses of a volume. Visibility is computed once per position, in parallel
// over positions.
// @param orientations  By position (heights, norths, easts): indices of orientations (headings,
//                      tilts).
void FillVolume(const PoseScorer& scorer,
                std::span<const std::vector<std::uint32_t>> orientations,
                int threads,
                PoseVolume& volume);

// Looks at all poses.
PoseVolume ComputeVolume(const PoseScorer& scorer,
                         std::span<const Tilt> tilts,
                         const MapOptions& options,
                         int threads);

// The highest places of the volume that are at least the separation of the options apart, highest
// first.
std::vector<ScoredPose> FindModes(const PoseVolume& volume,
                                  const PoseSpace& space,
                                  const MapOptions& options);

// Energies by position, the least over heights and orientations.
EnergyMap MapOf(const PoseVolume& volume, const PoseSpace& space, const CityModel& model);

}  // namespace ridgeline
