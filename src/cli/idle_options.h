// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "localize/localizer_options.h"

namespace ridgeline {

// Throws InputError for an assignment "key=value" of --set to an option that the other options
// leave without effect, such as search.map.tilts with search.method=sampler, and says what would
// make it work. A configuration file is not asked: it holds all options.
void RefuseIdleOptions(const std::vector<std::string>& assignments,
                       const LocalizerOptions& options);

}  // namespace ridgeline
