// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "cli/context.h"

namespace ridgeline {

// "ridgeline 0.1.0".
std::string VersionText();

// `ridgeline version`: the version and those of the libraries the results depend on.
void AddVersionCommand(CLI::App& app, Context& context);

}  // namespace ridgeline
