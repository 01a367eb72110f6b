// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "localize/localization.h"

namespace ridgeline {

// The modes that are not within 2 m and 2 degrees of a better one: to whoever looks at them, those
// are the same answer. Best first, as given.
std::vector<PoseMode> DistinctModes(std::span<const PoseMode> modes);

}  // namespace ridgeline
