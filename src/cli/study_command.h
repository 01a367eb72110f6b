// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>

#include "cli/context.h"

namespace ridgeline {

// `ridgeline study`: how far scores can be trusted on the queries of a dataset.
void AddStudyCommand(CLI::App& app, Context& context);

}  // namespace ridgeline
