// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "synth/town.h"

namespace ridgeline {

// Adds the block in the lattice cell (column, row) and its buildings. Buildings of a block touch at
// most; they never overlap, and they stay within the pavement.
void AddBlock(int column, int row, Town& town);

}  // namespace ridgeline
