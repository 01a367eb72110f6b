// SPDX-License-Identifier: Apache-2.0
#include "cli/file_name.h"

#include <cctype>

namespace ridgeline {

std::string FileNameOf(const std::string& text) {
  std::string name = text;
  for (char& c : name) {
    const bool plain = std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '-' || c == '_' ||
                       c == '.' || static_cast<unsigned char>(c) >= 0x80;
    if (!plain) c = '_';
  }
  return name;
}

}  // namespace ridgeline
