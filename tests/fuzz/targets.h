// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

namespace ridgeline::fuzz {

// A reader of input from outside, given any bytes. It may refuse them with an InputError, which is
// swallowed; anything else that is thrown, and a crash, is a finding.
struct FuzzTarget {
  std::string_view name;
  void (*run)(std::span<const std::uint8_t> bytes);
};

// One for every reader; the corpus of each is tests/fuzz/corpus/NAME/.
std::span<const FuzzTarget> FuzzTargets();

// nullptr: no target of that name.
const FuzzTarget* FindFuzzTarget(std::string_view name);

}  // namespace ridgeline::fuzz
