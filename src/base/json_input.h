// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>

namespace ridgeline {

// The one door for JSON from outside: every reader of a JSON file or line goes through it. Throws
// InputError with the file, the place and the byte for text that is not JSON or ends early, that is
// not UTF-8, is nested deeper than limits::kJsonDepth, has a key twice in one object, or a number
// beyond the range of a double. What comes back is safe to copy, print and destroy.
//
// @param place  Where in the file the text stands, e.g. "line 3"; may be empty.
nlohmann::json ParseJson(std::string_view text,
                         const std::string& file,
                         const std::string& place = "");

// A value as it is written, cut to what fits into a message. Never throws.
std::string JsonText(const nlohmann::json& value);

}  // namespace ridgeline
