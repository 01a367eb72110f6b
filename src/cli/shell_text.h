// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace ridgeline {

// Texts made from the same command line definition as --help.

// Completion scripts: commands, options, choices, files.
std::string BashCompletion(const CLI::App& program);
std::string ZshCompletion(const CLI::App& program);

// A man page in troff: of the program, or of one of its commands.
std::string ProgramManual(const CLI::App& program);
std::string CommandManual(const CLI::App& program, const CLI::App& command);

}  // namespace ridgeline
