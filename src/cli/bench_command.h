// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>

#include "cli/context.h"

namespace ridgeline {

// `ridgeline bench`: localizes a dataset and scores the poses against its truths.
void AddBenchCommand(CLI::App& app, Context& context);

}  // namespace ridgeline
