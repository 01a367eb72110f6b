// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "city/city_model.h"
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

// Multiplies the confidence of an answer by a factor, and decides anew.
// @param on_limit  Whether the answer lies on a limit of the search.
void Reconsider(double factor,
                bool on_limit,
                const ConfidenceOptions& options,
                Localization& result);

// A building in words: its id, with that of the building that it is a part of.
std::string NameOf(const Building& building);

}  // namespace ridgeline
