// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>

#include "cli/context.h"

namespace ridgeline {

// `ridgeline track`: a trajectory from pictures in order.
void AddTrackCommand(CLI::App& app, Context& context);

}  // namespace ridgeline
