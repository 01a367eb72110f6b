// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>

#include "cli/context.h"

namespace ridgeline {

void AddReplayCommand(CLI::App& app, Context& context);

}  // namespace ridgeline
