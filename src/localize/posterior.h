// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "localize/localization.h"
#include "localize/localizer_options.h"
#include "localize/pose_volume.h"

namespace ridgeline {

// What is believed about a pose, from how well all other poses of the box explain the picture.
struct Posterior {
  double mass = 0.0;  // of the poses within 2 m and 2 degrees, [0, 1]
  PoseSpread spread;
};

// Posterior of a dense volume under a uniform prior, P ~ exp(log_ratio / temperature), with each
// refined mode taken at its own height. `modes`: refined, best first; not empty.
Posterior PosteriorOf(const PoseVolume& volume,
                      std::span<const ScoredPose> modes,
                      const PoseSpace& space,
                      const ConfidenceOptions& options);

// The same from refined modes alone, where there is no volume.
Posterior PosteriorOf(std::span<const ScoredPose> modes, const ConfidenceOptions& options);

}  // namespace ridgeline
