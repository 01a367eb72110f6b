// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <vector>

#include "eval/protocol.h"
#include "localize/localizer_options.h"
#include "study/score_choice.h"

namespace ridgeline {

// Throws InputError for an assignment "key=value" of --set to an option that a study of these
// scores under this protocol never reads, and says why. A configuration file is not asked: it holds
// all options.
void RefuseUnreadOptions(const std::vector<std::string>& assignments,
                         const LocalizerOptions& options,
                         std::span<const ScoreChoice> scores,
                         bool scores_are_named,
                         const Protocol& protocol);

}  // namespace ridgeline
