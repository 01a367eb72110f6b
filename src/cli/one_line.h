// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace ridgeline {

// What a file holds, as part of a line for a terminal: cut, and without what would move or colour it.
std::string OneLine(std::string_view text, std::size_t most = 2000);

}  // namespace ridgeline
