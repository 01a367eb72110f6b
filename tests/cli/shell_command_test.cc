// SPDX-License-Identifier: Apache-2.0
#include "cli/shell_command.h"

#include <gtest/gtest.h>

#include <array>
#include <cstdio>
#include <string>
#include <vector>

namespace ridgeline {
namespace {

// What a shell makes of it.
std::string Echoed(const ShellCommand& command) {
  std::FILE* pipe = ::popen(command.text().c_str(), "r");
  std::string text;
  std::array<char, 256> part{};
  while (std::fgets(part.data(), part.size(), pipe) != nullptr) text += part.data();
  ::pclose(pipe);
  return text;
}

TEST(ShellCommand, PlainWordsStayAsTheyAre) {
  const ShellCommand command = ShellCommand("ridgeline bench")
                                  .Word("town/dataset.json")
                                  .Option("--set", std::vector<std::string>{"a.b=1", "c=x,y"})
                                  .Option("--world", "");
  EXPECT_EQ(command.text(), "ridgeline bench town/dataset.json --set a.b=1 --set c=x,y");
}

TEST(ShellCommand, AShellReadsEachWordAsItIs) {
  for (const std::string word : {"my town/dataset.json",
                                 "it's",
                                 "$HOME",
                                 "a;b",
                                 "*",
                                 "\"x\"",
                                 "`id`",
                                 "a\\b",
                                 "~",
                                 "stra\xc3\x9f" "e"}) {
    EXPECT_EQ(Echoed(ShellCommand("printf '%s|%s'").Word(word).Option("-x", word)),
              word + "|-x" + word + "|") << word;
  }
}

}  // namespace
}  // namespace ridgeline
