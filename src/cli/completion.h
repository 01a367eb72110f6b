// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>

#include "cli/context.h"

namespace ridgeline {

// `ridgeline completion`: shell completion and man pages, made from the program's own definition.
void AddCompletionCommand(CLI::App& app, Context& context);

}  // namespace ridgeline
