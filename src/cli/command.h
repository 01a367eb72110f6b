// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "base/options.h"
#include "cli/context.h"

namespace ridgeline {

// Name, one sentence and an example of a command, for its --help and man page.
struct CommandText {
  std::string name;
  std::string description;
  std::string example;  // whole lines to type, separated by newlines
};

// Adds a command to the program; `run` gets the context and returns an exit code. It is called
// after all arguments were parsed, so `arguments` kept in it by shared pointer are complete.
CLI::App* AddCommand(CLI::App& app,
                     Context& context,
                     const CommandText& text,
                     std::function<int(Context&)> run);

// --config and --set of a command.
struct ConfigArguments {
  std::string config;            // file, or the name of a shipped one ("paper"); empty: defaults
  std::vector<std::string> set;  // "path.to.key=value", applied after the file
};
void AddConfigOptions(CLI::App& command, ConfigArguments& arguments);
// Reads the file, then the assignments, over the present values. Throws InputError.
void ApplyConfig(const ConfigArguments& arguments, const VisitOptions& options);

// The folder of shipped configurations: beside the installed program (share/ridgeline/configs) or
// above the build folder (configs). Empty if there is none.
std::filesystem::path ShippedConfigs();

}  // namespace ridgeline
