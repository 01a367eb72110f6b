// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>

#include "cli/context.h"

namespace ridgeline {

// `ridgeline augment`: a building that is not there yet, in a photo.
void AddAugmentCommand(CLI::App& app, Context& context);

}  // namespace ridgeline
