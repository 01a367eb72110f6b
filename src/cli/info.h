// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>

#include "cli/context.h"

namespace ridgeline {

// `ridgeline info`: what is in models, terrain models and pictures.
void AddInfoCommand(CLI::App& app, Context& context);

}  // namespace ridgeline
