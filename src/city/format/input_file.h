// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <memory>
#include <string>

namespace ridgeline {

// A model file read in order: plain, gzipped (*.gz), or anything GDAL's virtual file systems know
// (/vsizip/, /vsicurl/). Throws InputError if it is missing, no regular file, or cannot be
// read, and where a packed file grows beyond 64 times its size.
class InputFile {
 public:
  explicit InputFile(const std::filesystem::path& path);
  ~InputFile();
  InputFile(const InputFile&) = delete;
  InputFile& operator=(const InputFile&) = delete;

  // Reads up to `size` bytes; 0 at the end.
  std::size_t Read(char* buffer, std::size_t size);
  // The whole rest.
  std::string ReadAll();
  const std::string& name() const { return name_; }

 private:
  struct Impl;
  std::string name_;
  std::unique_ptr<Impl> impl_;
  std::uint64_t bytes_read_ = 0;
  std::uint64_t most_bytes_ = std::numeric_limits<std::uint64_t>::max();
};

}  // namespace ridgeline
