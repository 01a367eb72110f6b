// SPDX-License-Identifier: Apache-2.0
#include "base/format_text.h"

#include <cstdarg>
#include <cstdio>

namespace ridgeline {

std::string FormatText(const char* format, ...) {
  char text[320];
  va_list arguments;
  va_start(arguments, format);
  std::vsnprintf(text, sizeof(text), format, arguments);
  va_end(arguments);
  return text;
}

}  // namespace ridgeline
