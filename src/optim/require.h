// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <sstream>
#include <string>

#include "base/error.h"

namespace ridgeline {

// Throws InputError for an option of a sampler ("tpe.candidates") that is not good.
template <typename T>
void Require(bool good, const char* field, const T& found, const char* expected) {
  if (good) return;
  std::ostringstream text;
  text << found;
  throw InputError("", std::string("sampler.") + field, text.str(), expected);
}

}  // namespace ridgeline
