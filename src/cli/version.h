// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>

#include "cli/context.h"
#include "cli/version_text.h"

namespace ridgeline {

// `ridgeline version`: the version and those of the libraries the results depend on.
void AddVersionCommand(CLI::App& app, Context& context);

}  // namespace ridgeline
