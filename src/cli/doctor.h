// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>

#include "cli/context.h"

namespace ridgeline {

// `ridgeline doctor`: checks the set-up and says what to do.
void AddDoctorCommand(CLI::App& app, Context& context);

}  // namespace ridgeline
