// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace ridgeline {

// A text with numbers, as printf; cut at 319 bytes. For notes and doubts.
[[gnu::format(printf, 1, 2)]] std::string FormatText(const char* format, ...);

}  // namespace ridgeline
