// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

namespace ridgeline {

// Whole content of a text file, without the mark of byte order that spreadsheets put before UTF-8.
// Throws InputError if it cannot be read.
std::string ReadText(const std::filesystem::path& path);

}  // namespace ridgeline
