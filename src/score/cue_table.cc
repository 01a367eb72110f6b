// SPDX-License-Identifier: Apache-2.0
#include "score/cue_table.h"

#include <algorithm>

#include "base/error.h"

namespace ridgeline {

extern const CuePlugin kEdgeCues;
extern const CuePlugin kSkyCue;
extern const CuePlugin kFacadeCue;
extern const CuePlugin kColourCues;

namespace {

std::vector<const CuePlugin*>& Cues() {
  static std::vector<const CuePlugin*> table = {&kEdgeCues, &kSkyCue, &kFacadeCue, &kColourCues};
  return table;
}

}  // namespace

std::span<const CuePlugin* const> CueTable() { return Cues(); }

void AddCue(const CuePlugin& plugin) {
  const std::vector<std::string> taken = CueNames();
  for (const CueName& cue : plugin.names) {
    if (std::find(taken.begin(), taken.end(), cue.name) != taken.end()) {
      throw InputError("", "cue", "\"" + std::string(cue.name) + "\" again", "a name of its own");
    }
  }
  Cues().push_back(&plugin);
}

std::vector<std::string> CueNames() {
  std::vector<std::string> names;
  for (const CuePlugin* plugin : CueTable()) {
    for (const CueName& cue : plugin->names) names.emplace_back(cue.name);
  }
  return names;
}

}  // namespace ridgeline
