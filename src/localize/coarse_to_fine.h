// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "localize/pose_volume.h"

namespace ridgeline {

// The volume of ComputeVolume at a fraction of its cost, for a score that can be made tolerant.
// First some places and headings are looked at, with a tolerance of the distance between them; then
// all poses between those that come near the best. The others keep the highest value around them:
// they are exp(-15) times as probable as the best pose, or less.
//
// @param tolerant  The score for the first look, with the tolerance of CoarseSpacingOf().
// @param fine      The score for the poses of the volume.
PoseVolume ComputeVolumeCoarseToFine(const PoseScorer& tolerant,
                                     const PoseScorer& fine,
                                     std::span<const Tilt> tilts,
                                     const MapOptions& options,
                                     int threads);

// Between the headings first looked at [deg].
inline constexpr double kFirstHeadingStepDeg = 2.0;

// Distance [m] of the places first looked at.
double CoarseSpacingOf(const PoseSpaceOptions& ranges, const MapOptions& options);

}  // namespace ridgeline
