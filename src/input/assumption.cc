// SPDX-License-Identifier: Apache-2.0
#include "input/assumption.h"

namespace ridgeline {

std::string TextOf(const Assumption& assumption) {
  return assumption.what.empty() ? assumption.value : assumption.what + ": " + assumption.value;
}

Assumption AssumptionOf(const std::string& line, const std::string& source) {
  const std::size_t colon = line.find(": ");
  if (colon == std::string::npos) return {"", line, source};
  return {line.substr(0, colon), line.substr(colon + 2), source};
}

}  // namespace ridgeline
