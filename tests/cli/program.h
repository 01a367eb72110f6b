// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

namespace ridgeline::testing {

// What a run of the program did.
struct Outcome {
  int exit_code = -1;
  std::string text;  // stdout, and stderr unless it was sent elsewhere
};

// Runs the program with a shell's command line.
Outcome Ridgeline(const std::string& arguments);

// An empty folder of this process, since ctest runs tests side by side; removed at its end. Its
// path has a blank, as users' paths have.
std::filesystem::path Scratch(const std::string& name);

// For a shell.
std::string Quoted(const std::filesystem::path& path);

// A town of one picture of 320 x 240 px, street_000; made once.
const std::filesystem::path& Town();

}  // namespace ridgeline::testing
