// SPDX-License-Identifier: Apache-2.0
#include "base/regular_file.h"

#include <system_error>

#include "base/error.h"

namespace ridgeline {
namespace fs = std::filesystem;

void RequireRegularFile(const fs::path& path, const std::string& expected) {
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (fs::is_regular_file(status)) return;
  if (fs::is_directory(status)) throw InputError(path.string(), "", "a folder", expected);
  if (fs::exists(status)) {
    throw InputError(path.string(), "", "a pipe or a device", expected + ", as a regular file");
  }
  const bool absent = error == std::errc::no_such_file_or_directory || !error;
  throw InputError(path.string(), "", absent ? "no such file" : error.message(), expected);
}

}  // namespace ridgeline
