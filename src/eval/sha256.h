// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace ridgeline {

// SHA-256 (FIPS 180-4) in 64 small hexadecimal digits, as sha256sum prints it.
std::string Sha256Of(std::string_view bytes);

// Of a file's content. Throws InputError if it cannot be read to its end.
std::string Sha256OfFile(const std::filesystem::path& path);

}  // namespace ridgeline
