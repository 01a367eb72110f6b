// SPDX-License-Identifier: Apache-2.0
#include "base/text_file.h"

#include "base/atomic_file.h"

namespace ridgeline {

std::string ReadText(const std::filesystem::path& path) {
  std::string text = ReadFile(path);
  if (text.starts_with("\xEF\xBB\xBF")) text.erase(0, 3);
  return text;
}

}  // namespace ridgeline
