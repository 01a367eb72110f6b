// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace ridgeline {

// Something that an input leaves open or says in other words, and what was made of it.
struct Assumption {
  std::string what;    // "height", "heading", "camera", ...
  std::string value;   // in words, e.g. "terrain + 1.7 m assumed"
  std::string source;  // file or option that it is about
};

// "height: terrain + 1.7 m assumed".
std::string TextOf(const Assumption& assumption);

// Of a line "what: value"; a line without a colon is all value.
Assumption AssumptionOf(const std::string& line, const std::string& source);

}  // namespace ridgeline
