// SPDX-License-Identifier: Apache-2.0
#include "cli/one_line.h"

#include <algorithm>

namespace ridgeline {

std::string OneLine(std::string_view text, std::size_t most) {
  std::string line(text.substr(0, most));
  if (text.size() > most) line += "...";
  constexpr char kDelete = 0x7f;
  std::replace_if(
      line.begin(), line.end(), [](char c) { return (c >= 0 && c < ' ') || c == kDelete; }, ' ');
  return line;
}

}  // namespace ridgeline
