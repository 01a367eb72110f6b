// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace ridgeline {

// A folder for results, made before the work so that it fails then and not after. If the work
// fails, and nothing was put in it, it is removed again with the parents that were made for it.
class OutFolder {
 public:
  // Throws InputError, naming the option, if the folder cannot be made or written. An empty path is
  // no folder.
  OutFolder(const std::string& option, const std::filesystem::path& path);
  ~OutFolder();
  OutFolder(const OutFolder&) = delete;
  OutFolder& operator=(const OutFolder&) = delete;

 private:
  std::vector<std::filesystem::path> made_;  // parents first
};

// Throws InputError, naming the option, if a file of this name cannot be written. "" is no file.
void CheckFileToWrite(const std::string& option, const std::string& file);

}  // namespace ridgeline
