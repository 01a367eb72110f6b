// SPDX-License-Identifier: Apache-2.0
#include "cli/out_folder.h"

#include <unistd.h>

#include <algorithm>
#include <system_error>

#include "base/error.h"

namespace ridgeline {

namespace fs = std::filesystem;

OutFolder::OutFolder(const std::string& option, const fs::path& path) {
  if (path.empty()) return;
  std::error_code error;
  for (fs::path folder = fs::absolute(path).lexically_normal();
       !folder.empty() && !fs::exists(folder, error) && folder.has_relative_path();
       folder = folder.parent_path()) {
    if (folder.has_filename()) made_.push_back(folder);
  }
  std::reverse(made_.begin(), made_.end());
  fs::create_directories(path, error);
  const bool is_folder = fs::is_directory(path);
  if (error || !is_folder || ::access(path.c_str(), W_OK) != 0) {
    const std::string reason = error       ? error.message()
                               : is_folder ? "no permission to write"
                                           : "a file";
    throw InputError(option, "", path.string() + ": " + reason, "a folder that can be written");
  }
}

void CheckFileToWrite(const std::string& option, const std::string& file) {
  if (file.empty()) return;
  const fs::path path = file;
  const fs::path folder = path.has_parent_path() ? path.parent_path() : fs::path(".");
  std::error_code error;
  fs::create_directories(folder, error);
  if (!fs::is_directory(folder, error)) {
    throw InputError(option, "", file, "a file in a folder that exists or can be made");
  }
  if (fs::is_directory(path, error) || ::access(folder.c_str(), W_OK) != 0) {
    throw InputError(option, "", file, "a file in a folder that can be written");
  }
}

// Only empty folders can be removed this way.
OutFolder::~OutFolder() {
  std::error_code ignored;
  for (auto folder = made_.rbegin(); folder != made_.rend(); ++folder) fs::remove(*folder, ignored);
}

}  // namespace ridgeline
