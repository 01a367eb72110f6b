// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>

#include "cli/context.h"

namespace ridgeline {

// `ridgeline index`: the tiles of a city into one store.
void AddIndexCommand(CLI::App& app, Context& context);

}  // namespace ridgeline
