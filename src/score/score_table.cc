// SPDX-License-Identifier: Apache-2.0
#include "score/score_table.h"

#include <algorithm>

#include "base/error.h"

namespace ridgeline {

extern const ScorePlugin kAreaScore;
extern const ScorePlugin kEvidenceScore;
extern const ScorePlugin kGradientScore;
extern const ScorePlugin kLineEnergyScore;
extern const ScorePlugin kOrientedChamferScore;
extern const ScorePlugin kRayLineEnergyScore;
extern const ScorePlugin kSkylineL1Score;
extern const ScorePlugin kUnexplainedScore;
extern const ScorePlugin kZbufferLineEnergyScore;

namespace {

std::vector<const ScorePlugin*>& Scores() {
  static std::vector<const ScorePlugin*> table = {&kEvidenceScore,
                                                  &kLineEnergyScore,
                                                  &kZbufferLineEnergyScore,
                                                  &kSkylineL1Score,
                                                  &kGradientScore,
                                                  &kOrientedChamferScore,
                                                  &kUnexplainedScore,
                                                  &kAreaScore,
                                                  &kRayLineEnergyScore};
  return table;
}

}  // namespace

std::span<const ScorePlugin* const> ScoreTable() { return Scores(); }

void AddScore(const ScorePlugin& plugin) {
  const std::vector<std::string> taken = ScoreNames();
  if (std::find(taken.begin(), taken.end(), plugin.name) != taken.end()) {
    throw InputError(
        "", "score", "\"" + std::string(plugin.name) + "\" again", "a name of its own");
  }
  Scores().push_back(&plugin);
}

std::vector<std::string> ScoreNames() {
  std::vector<std::string> names;
  for (const ScorePlugin* score : ScoreTable()) names.emplace_back(score->name);
  return names;
}

const ScorePlugin& FindScore(const std::string& name) {
  std::string known;
  for (const ScorePlugin* score : ScoreTable()) {
    if (score->name == name) return *score;
    known += (known.empty() ? "" : ", ") + std::string(score->name);
  }
  throw InputError("", "score.name", "\"" + name + "\"", "one of " + known);
}

std::unique_ptr<Score> MakeScore(const ScoreContext& context) {
  return FindScore(context.options.name).make(context);
}

}  // namespace ridgeline
