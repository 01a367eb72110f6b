// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <vector>

#include "score/cue.h"

namespace ridgeline {

// All cues; their values stand in this order. Valid until the next AddCue().
std::span<const CuePlugin* const> CueTable();

// Adds a cue of a program of its own to the table (examples/custom_cue.cc): at the program's start,
// before any options are made, which hold what the cues declare. `plugin` must outlive the
// program's work. Throws InputError for a name that the table has.
void AddCue(const CuePlugin& plugin);

// Names of all values of all cues, in the order of the table.
std::vector<std::string> CueNames();

}  // namespace ridgeline
