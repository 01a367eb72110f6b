// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "city/raise_roofs.h"
#include "localize/goodness.h"
#include "localize/localizer_options.h"
#include "localize/pose_scorer.h"
#include "score/picture_evidence.h"

namespace ridgeline {

// What a roof is tried with: the picture, the model, and its roofs that were moved before.
struct RoofTrial {
  const PictureEvidence& picture;
  const CityModel& model;
  const PoseSpace& space;
  const LocalizerOptions& options;
  const std::vector<RoofShift>& settled;
};

// The roof that the picture puts at another height than the model, clearly enough to search with it
// there: each of the most telling buildings is tried up to two metres up and down, the camera turned
// as fits the picture best (at the pose itself the tilt has swallowed what a roof is off by).
// Settled buildings are left out. Nullopt: none gains six nats.
std::optional<RoofShift> RoofInDoubt(const RoofTrial& trial,
                                     const Goodness& goodness,
                                     const ScoredPose& best);

}  // namespace ridgeline
