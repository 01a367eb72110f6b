// SPDX-License-Identifier: Apache-2.0
// The entry of libFuzzer, for the target that RIDGELINE_FUZZ_TARGET names (scripts/fuzz.sh).
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>

#include "fuzz/targets.h"

namespace {

const ridgeline::fuzz::FuzzTarget& Target() {
  static const ridgeline::fuzz::FuzzTarget* const target = [] {
    const char* const name = std::getenv("RIDGELINE_FUZZ_TARGET");
    const auto* found = ridgeline::fuzz::FindFuzzTarget(name != nullptr ? name : "");
    if (found != nullptr) return found;
    std::fputs("RIDGELINE_FUZZ_TARGET is to be one of:", stderr);
    for (const auto& known : ridgeline::fuzz::FuzzTargets()) {
      std::fprintf(stderr, " %.*s", static_cast<int>(known.name.size()), known.name.data());
    }
    std::fputs("\n", stderr);
    std::exit(2);
  }();
  return *target;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  Target().run({data, size});
  return 0;
}
