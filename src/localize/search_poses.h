// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "localize/background.h"
#include "localize/localizer_options.h"
#include "localize/pose_scorer.h"
#include "localize/pose_volume.h"
#include "score/picture_evidence.h"

namespace ridgeline {

// What a search over the whole box has found.
struct SearchedPoses {
  std::vector<ScoredPose> modes;     // distinct, best first; empty: none sees the model
  std::optional<PoseVolume> volume;  // of the dense map; absent for samplers
  double spacing_m = 1.0;            // between the places looked at
  std::uint64_t evaluations = 0;
  std::vector<BackgroundPose> background;  // best first; empty for samplers and the like
  // How far the best of the box stands above the best of the background [nat], both by the first look
  // or both refined; not known for samplers, for scores without a tolerance, and where there are no
  // other places.
  std::optional<double> above_background;
};

// Three lines in general position fix a pose; one more tells whether it is right. Why a picture with
// fewer is not searched, in words; empty: it is.
std::string TooFewLines(std::size_t lines);

// The dense map, or the sampler, that the options name. The map looks under the tilts that the
// picture's vertical lines suggest.
SearchedPoses SearchPoses(const PoseScorer& scorer,
                          const PictureEvidence& picture,
                          const SearchOptions& options,
                          std::uint64_t seed,
                          int threads);

// The dense map with the tilts and the tolerance that belong to its spacing.
PoseVolume MapPoses(const PoseScorer& scorer,
                    const PictureEvidence& picture,
                    const MapOptions& options,
                    int threads);

// Refines the modes on the exact score, all a little and the better ones to the end, and sorts
// them, best first; and the best of the background, to which they are then compared. Returns the
// number of energies computed.
std::uint64_t RefineModes(const PoseScorer& scorer, int threads, SearchedPoses& found);

}  // namespace ridgeline
