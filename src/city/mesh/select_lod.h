// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "city/source_model.h"

namespace ridgeline {

// Level of detail to read for each building of `model`: `wanted` where the building or one of its
// parts has it; else the next higher, else the next lower one down to 1. A building whose parts
// have the level is not also taken at a lower one. -1: nothing with a volume; such buildings are
// counted in the tally, by name, as are those that were not read at the wanted level.
std::vector<std::int8_t> SelectLod(SourceModel& model, int wanted);

}  // namespace ridgeline
