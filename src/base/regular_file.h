// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

namespace ridgeline {

// Throws InputError unless the path is a regular file, before anything opens it: a pipe would wait
// for ever, a device has no end.
//
// @param expected  What the file should be, e.g. "a picture".
void RequireRegularFile(const std::filesystem::path& path, const std::string& expected = "a file");

}  // namespace ridgeline
