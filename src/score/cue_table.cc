// SPDX-License-Identifier: Apache-2.0
#include "score/cue_table.h"

#include <array>

namespace ridgeline {

extern const CuePlugin kEdgeCues;
extern const CuePlugin kSkyCue;
extern const CuePlugin kFacadeCue;
extern const CuePlugin kColourCues;

std::span<const CuePlugin* const> CueTable() {
  static constexpr std::array kTable = {&kEdgeCues, &kSkyCue, &kFacadeCue, &kColourCues};
  return kTable;
}

std::vector<std::string> CueNames() {
  std::vector<std::string> names;
  for (const CuePlugin* plugin : CueTable()) {
    for (const CueName& cue : plugin->names) names.emplace_back(cue.name);
  }
  return names;
}

}  // namespace ridgeline
