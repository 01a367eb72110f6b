// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>

namespace ridgeline {

// A check for options without a sign: the parser takes -1 and 10^20 for the largest number there is.
CLI::Validator Unsigned();

}  // namespace ridgeline
