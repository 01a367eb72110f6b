// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <string>

#include "base/option_groups.h"
#include "base/options.h"
#include "score/evidence_options.h"

namespace ridgeline {

struct ScoreOptions {
  // One of ScoreNames(), see score_table.h. "evidence" is ours, the sum of all cues.
  std::string name = "evidence";
  // Weights of the cues by name: the maximum likelihood of the dev queries (docs/scores.md has the
  // command). Those of the cue table; an absent one is 0.
  std::map<std::string, double> weights;
  EvidenceOptions evidence;
  // Those of all scores in the table, e.g. groups.Get<SkylineL1Options>().
  OptionGroups groups;

  ScoreOptions();
  void Visit(OptionVisitor& v);
};

}  // namespace ridgeline
