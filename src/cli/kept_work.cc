// SPDX-License-Identifier: Apache-2.0
#include "cli/kept_work.h"

#include "base/error.h"

namespace ridgeline {

void AddKeptWorkOptions(CLI::App& command, const std::string& pieces, KeptWork& work) {
  command.add_option("--query", work.queries, "These queries only; by commas, or repeated")
      ->type_name("ID")
      ->delimiter(',')
      ->allow_extra_args(false);
  command.add_option("--set-name", work.sets, "Queries of these sets only")
      ->type_name("NAME")
      ->delimiter(',')
      ->allow_extra_args(false);
  command.add_flag("--resume",
                   work.resume,
                   "Go on with what --out holds of the same work; begin where it holds nothing");
  command
      .add_option("--shard",
                  work.shard,
                  "The i-th of n parts of the " + pieces +
                      "; `ridgeline merge` puts them together")
      ->type_name("I/N");
}

void CheckKeeping(const KeptWork& work, const std::string& out, const std::string& pieces) {
  if (!out.empty()) return;
  if (work.resume) {
    throw InputError("--resume", "", "no --out", "--out with the folder of the results");
  }
  if (!work.shard.empty()) {
    throw InputError("--shard", "", "no --out", "--out with a folder for its " + pieces);
  }
}

void AddChoice(const KeptWork& work, ShellCommand& command) {
  command.Option("--query", work.queries).Option("--set-name", work.sets);
}

}  // namespace ridgeline
