// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>

#include "cli/context.h"

namespace ridgeline {

// `ridgeline merge A B ... --out DIR`: the shards of a bench or a study as if they had been one.
void AddMergeCommand(CLI::App& app, Context& context);

}  // namespace ridgeline
