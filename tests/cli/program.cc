// SPDX-License-Identifier: Apache-2.0
#include "cli/program.h"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cstdio>
#include <system_error>

namespace ridgeline::testing {

namespace fs = std::filesystem;

Outcome Ridgeline(const std::string& arguments) {
  const std::string command = std::string(RIDGELINE_PROGRAM) + " " + arguments + " 2>&1";
  FILE* pipe = ::popen(command.c_str(), "r");
  Outcome outcome;
  std::array<char, 4096> buffer{};
  std::size_t count = 0;
  while ((count = std::fread(buffer.data(), 1, buffer.size(), pipe)) > 0) {
    outcome.text.append(buffer.data(), count);
  }
  const int status = ::pclose(pipe);
  outcome.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  return outcome;
}

namespace {

const fs::path& ProcessFolder() {
  struct Folder {
    fs::path path =
        fs::path(::testing::TempDir()) / ("ridgeline cli " + std::to_string(::getpid()));
    const pid_t owner = ::getpid();
    ~Folder() {
      std::error_code ignored;
      if (::getpid() == owner) fs::remove_all(path, ignored);
    }
  };
  static const Folder folder;
  return folder.path;
}

}  // namespace

fs::path Scratch(const std::string& name) {
  const fs::path folder = ProcessFolder() / name;
  fs::remove_all(folder);
  fs::create_directories(folder);
  return folder;
}

std::string Quoted(const fs::path& path) { return "'" + path.string() + "'"; }

const fs::path& Town() {
  static const fs::path town = [] {
    const fs::path folder = Scratch("town") / "town";
    Ridgeline(
        "synth --quiet --queries 1 --tilted 0 --portrait 0 --drone 0 --size 320x240 "
        "--set town.blocks_east=2 --set town.blocks_north=2 --out " +
        Quoted(folder));
    return folder;
  }();
  return town;
}

}  // namespace ridgeline::testing
