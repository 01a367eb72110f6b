// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace ridgeline {

// A file name for a text, e.g. a query's id; what file systems dislike becomes '_'.
std::string FileNameOf(const std::string& text);

}  // namespace ridgeline
