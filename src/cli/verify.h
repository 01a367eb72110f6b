// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>

#include "cli/context.h"

namespace ridgeline {

// `ridgeline verify DIR`: whether results still are what their inputs give.
void AddVerifyCommand(CLI::App& app, Context& context);

}  // namespace ridgeline
