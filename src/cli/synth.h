// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>

#include "cli/context.h"

namespace ridgeline {

// `ridgeline synth`: an invented town with pictures, as a dataset.
void AddSynthCommand(CLI::App& app, Context& context);

}  // namespace ridgeline
