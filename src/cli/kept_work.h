// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "cli/shell_command.h"

namespace ridgeline {

// Which part of a long work is done, and whether it goes on with what is there: bench and study.
struct KeptWork {
  std::vector<std::string> queries;  // ids; empty: all
  std::vector<std::string> sets;     // names; empty: all
  bool resume = false;
  std::string shard;  // "2/3"; empty: the whole
};

// Declares --query, --set-name, --resume and --shard.
// @param pieces  What the work consists of, e.g. "runs".
void AddKeptWorkOptions(CLI::App& command, const std::string& pieces, KeptWork& work);

// Throws InputError where --resume or --shard has no folder to keep the results in.
void CheckKeeping(const KeptWork& work, const std::string& out, const std::string& pieces);

// The choice as options of a command; none for all.
void AddChoice(const KeptWork& work, ShellCommand& command);

}  // namespace ridgeline
