// SPDX-License-Identifier: Apache-2.0
#include "cli/context.h"

#include <iostream>

#include "cli/one_line.h"

namespace ridgeline {

void Context::Print(std::string_view line) const { std::cout << line << '\n'; }

void Context::Note(std::string_view line) const {
  if (!quiet) std::cerr << OneLine(line) << '\n';
}

void Context::Warn(std::string_view line) const {
  if (quiet) return;
  std::cerr << Colored(color_err, Color::kYellow, "warning: ") << OneLine(line) << '\n';
}

std::string Colored(bool enabled, Color color, std::string_view text) {
  if (!enabled) return std::string(text);
  const char* code = "1";
  switch (color) {
    case Color::kBold:
      code = "1";
      break;
    case Color::kDim:
      code = "2";
      break;
    case Color::kRed:
      code = "1;31";
      break;
    case Color::kGreen:
      code = "32";
      break;
    case Color::kYellow:
      code = "33";
      break;
  }
  return std::string("\033[") + code + "m" + std::string(text) + "\033[0m";
}

}  // namespace ridgeline
