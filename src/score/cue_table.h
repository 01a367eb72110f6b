// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <vector>

#include "score/cue.h"

namespace ridgeline {

// All cues; their values stand in this order.
std::span<const CuePlugin* const> CueTable();

// Names of all values of all cues, in the order of the table.
std::vector<std::string> CueNames();

}  // namespace ridgeline
