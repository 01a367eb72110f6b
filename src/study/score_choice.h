// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "score/score_options.h"

namespace ridgeline {

// A score to be studied, under the name it is asked for by.
struct ScoreChoice {
  std::string name;
  ScoreOptions options;
};

// Names that ChooseScores() accepts: those of the scores, then those of the cues of "evidence",
// each of which stands for that cue alone, with its own weight (1 if that is 0).
std::vector<std::string> StudyScoreNames();

// The scores of these names, with `base` for all that a name leaves open. "all": every score and
// every cue. Without names, that of `base`. Throws InputError for a name that is none, with the
// nearest.
std::vector<ScoreChoice> ChooseScores(const std::vector<std::string>& names,
                                      const ScoreOptions& base);

}  // namespace ridgeline
