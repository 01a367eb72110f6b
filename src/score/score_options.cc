// SPDX-License-Identifier: Apache-2.0
#include "score/score_options.h"

#include <algorithm>
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
  v.Field("name", name, OneOf{ScoreNames()});
  v.Group("weights", [this](OptionVisitor& g) {
    const std::vector<std::string> cues = CueNames();
    for (const std::string& cue : cues) g.Field(cue, weights[cue], NotNegative());
    for (const auto& [cue, weight] : weights) {
      const bool is_known = std::find(cues.begin(), cues.end(), cue) != cues.end();
      g.Rule(cue, is_known, "an unknown cue", "e.g. \"" + NearestName(cue, cues) + "\"");
    }
  });
  v.Group("evidence", [this](OptionVisitor& g) { evidence.Visit(g); });
  groups.Visit(v);
}

}  // namespace ridgeline
