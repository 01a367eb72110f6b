// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>

#include "cli/context.h"

namespace ridgeline {

// `ridgeline convert`: datasets, poses and results from and to the formats of other programs.
void AddConvertCommand(CLI::App& app, Context& context);

}  // namespace ridgeline
