// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>

#include "cli/context.h"

namespace ridgeline {

// `ridgeline compare A B ...`: results of several systems on the same photos, pair by pair.
void AddCompareCommand(CLI::App& app, Context& context);

}  // namespace ridgeline
