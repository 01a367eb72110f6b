// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>

#include "cli/context.h"

namespace ridgeline {

// `ridgeline options`: every key of --set with its value.
void AddOptionsCommand(CLI::App& app, Context& context);

}  // namespace ridgeline
