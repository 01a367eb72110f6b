// SPDX-License-Identifier: Apache-2.0
#include "cli/shell_command.h"

#include <string_view>

namespace ridgeline {
namespace {

bool IsPlain(std::string_view word) {
  constexpr std::string_view kPlain =
      "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_./-=+:,@%";
  return !word.empty() && word.find_first_not_of(kPlain) == std::string_view::npos;
}

}  // namespace

ShellCommand& ShellCommand::Word(const std::string& word) {
  text_ += ' ';
  if (IsPlain(word)) {
    text_ += word;
    return *this;
  }
  text_ += '\'';
  for (const char c : word) text_ += c == '\'' ? std::string("'\\''") : std::string(1, c);
  text_ += '\'';
  return *this;
}

ShellCommand& ShellCommand::Option(const char* name, const std::string& value) {
  if (value.empty()) return *this;
  text_ += std::string(" ") + name;
  return Word(value);
}

ShellCommand& ShellCommand::Option(const char* name, const std::vector<std::string>& values) {
  for (const std::string& value : values) Option(name, value);
  return *this;
}

}  // namespace ridgeline
