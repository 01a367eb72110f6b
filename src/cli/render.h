// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>

#include "cli/context.h"

namespace ridgeline {

// `ridgeline render`: what the model shows from a pose.
void AddRenderCommand(CLI::App& app, Context& context);

}  // namespace ridgeline
