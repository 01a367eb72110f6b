// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>
#include <memory>

#include "cli/context.h"

namespace ridgeline {

// The whole command line: global options and every command. --help, the man pages and the shell
// completion are all made from it.
std::unique_ptr<CLI::App> MakeProgram(Context& context);

}  // namespace ridgeline
