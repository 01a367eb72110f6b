// SPDX-License-Identifier: Apache-2.0
#include "study/score_choice.h"

#include <algorithm>

#include "base/error.h"

namespace ridgeline {

std::vector<std::string> StudyScoreNames() {
  std::vector<std::string> names = ScoreNames();
  names.insert(names.end(), kCueNames.begin(), kCueNames.end());
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
    const auto cue = std::find(kCueNames.begin(), kCueNames.end(), name);
    if (cue == kCueNames.end()) {
      choice.options.name = name;
    } else {
      choice.options.name = "evidence";
      const auto k = static_cast<std::size_t>(cue - kCueNames.begin());
      // The weight keeps the energies readable: one nat of a cue is much, of another nothing.
      const double weight = base.weights[k] > 0.0 ? base.weights[k] : 1.0;
      choice.options.weights.assign(kCues, 0.0);
      choice.options.weights[k] = weight;
    }
    choices.push_back(std::move(choice));
  }
  return choices;
}

}  // namespace ridgeline
