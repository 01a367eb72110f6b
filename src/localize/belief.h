// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "localize/localization.h"
#include "localize/localizer_options.h"
#include "localize/search_poses.h"

namespace ridgeline {

// What to believe of the best mode that a search found: fills the result's confidence, spread,
// protection level, goodness, doubts and status, and the pose unless it is withheld.
// @param found  With modes, best first.
void Believe(const SearchedPoses& found,
             const PoseScorer& scorer,
             const ConfidenceOptions& options,
             Localization& result);

}  // namespace ridgeline
