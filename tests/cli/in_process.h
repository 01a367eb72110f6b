// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "cli/program.h"

namespace ridgeline::testing {

// Runs a command line of the program within this process, which is quicker than a process of its
// own where there are hundreds. Exit codes as main's; the text is stdout's and the error.
Outcome RunHere(const std::vector<std::string>& words);

}  // namespace ridgeline::testing
