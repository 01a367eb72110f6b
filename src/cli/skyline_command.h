// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>

#include "cli/context.h"

namespace ridgeline {

// `ridgeline skyline`: poses of a picture, a folder or a video by their skylines.
void AddSkylineCommand(CLI::App& app, Context& context);

}  // namespace ridgeline
