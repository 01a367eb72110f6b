// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "city/raise_roofs.h"
#include "localize/goodness.h"

namespace ridgeline {

// The roofs that the picture puts at another height than the model, clearly enough to try them
// there: at least half a metre, with a gain of three nats.
std::vector<RoofShift> RoofsInDoubt(const Goodness& goodness);

}  // namespace ridgeline
