// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "score/score_plugin.h"

namespace ridgeline {

// All scores. Valid until the next AddScore().
std::span<const ScorePlugin* const> ScoreTable();

// Adds a score of a program of its own to the table: at the program's start, before any options are
// made, which hold what the scores declare. `plugin` must outlive the program's work. Throws
// InputError for a name that the table has.
void AddScore(const ScorePlugin& plugin);

// Names that ScoreOptions::name accepts, in the order of the table.
std::vector<std::string> ScoreNames();

// Throws InputError for a name that no score of the table has.
const ScorePlugin& FindScore(const std::string& name);

// The score that the options name, for one picture. Throws as FindScore().
std::unique_ptr<Score> MakeScore(const ScoreContext& context);

}  // namespace ridgeline
