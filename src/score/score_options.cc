// SPDX-License-Identifier: Apache-2.0
#include "score/score_options.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/error.h"
#include "score/cue_table.h"
#include "score/score_table.h"

namespace ridgeline {

ScoreOptions::ScoreOptions() {
  for (const CuePlugin* plugin : CueTable()) {
    for (const CueName& cue : plugin->names) weights[cue.name] = cue.weight;
  }
  for (const ScorePlugin* score : ScoreTable()) score->declare(groups);
}

void ScoreOptions::Visit(OptionVisitor& v) {
  v.Field("name", name);
  v.Group("weights", [this](OptionVisitor& g) {
    for (const std::string& cue : CueNames()) g.Field(cue, weights[cue]);
  });
  v.Group("evidence", [this](OptionVisitor& g) { evidence.Visit(g); });
  groups.Visit(v);
}

void ScoreOptions::Validate() const {
  FindScore(name);
  const std::vector<std::string> cues = CueNames();
  for (const auto& [cue, weight] : weights) {
    const std::string field = "score.weights." + cue;
    if (std::find(cues.begin(), cues.end(), cue) == cues.end()) {
      throw InputError("", field, "an unknown cue", "e.g. \"" + NearestName(cue, cues) + "\"");
    }
    if (!(weight >= 0.0 && std::isfinite(weight))) {
      throw InputError("", field, std::to_string(weight), "a number >= 0");
    }
  }
  evidence.Validate();
  groups.Validate();
}

}  // namespace ridgeline
