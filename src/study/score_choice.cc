// SPDX-License-Identifier: Apache-2.0
#include "study/score_choice.h"

#include <algorithm>

#include "base/error.h"
#include "score/cue_table.h"
#include "score/score_table.h"

namespace ridgeline {

std::vector<std::string> StudyScoreNames() {
  std::vector<std::string> names = ScoreNames();
  const std::vector<std::string> cues = CueNames();
  names.insert(names.end(), cues.begin(), cues.end());
  return names;
}

std::vector<ScoreChoice> ChooseScores(const std::vector<std::string>& names,
                                      const ScoreOptions& base) {
  const std::vector<std::string> known = StudyScoreNames();
  std::vector<std::string> wanted = names;
  if (wanted.empty()) wanted = {base.name};
  if (std::find(wanted.begin(), wanted.end(), "all") != wanted.end()) wanted = known;
  std::vector<ScoreChoice> choices;
  for (const std::string& name : wanted) {
    if (std::find(known.begin(), known.end(), name) == known.end()) {
      throw InputError("--score",
                       "",
                       "\"" + name + "\"",
                       "a score, e.g. \"" + NearestName(name, known) + "\", or \"all\"");
    }
    const bool is_chosen = std::any_of(
        choices.begin(), choices.end(), [&](const ScoreChoice& c) { return c.name == name; });
    if (is_chosen) continue;
    ScoreChoice choice{name, base};
    const auto weight = base.weights.find(name);
    if (weight == base.weights.end()) {
      choice.options.name = name;
    } else {
      choice.options.name = "evidence";
      // The weight keeps the energies readable: one nat of a cue is much, of another nothing.
      choice.options.weights = {{name, weight->second > 0.0 ? weight->second : 1.0}};
    }
    choices.push_back(std::move(choice));
  }
  return choices;
}

}  // namespace ridgeline
