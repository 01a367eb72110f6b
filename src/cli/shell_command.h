// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace ridgeline {

// A command to be copied into a shell, as reports and hints show it: words that the shell would read
// otherwise (blanks, quotes, ...) are quoted.
class ShellCommand {
 public:
  // @param start  Program and command, e.g. "ridgeline bench".
  explicit ShellCommand(std::string start) : text_(std::move(start)) {}

  ShellCommand& Word(const std::string& word);
  // "--name value"; nothing for an empty value.
  ShellCommand& Option(const char* name, const std::string& value);
  // Once for each value.
  ShellCommand& Option(const char* name, const std::vector<std::string>& values);

  const std::string& text() const { return text_; }

 private:
  std::string text_;
};

}  // namespace ridgeline
