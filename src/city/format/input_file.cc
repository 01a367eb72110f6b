// SPDX-License-Identifier: Apache-2.0
#include "city/format/input_file.h"

#include <cpl_conv.h>
#include <cpl_vsi.h>

#include <algorithm>

#include "base/error.h"
#include "base/limits.h"
#include "city/format/openable.h"

namespace ridgeline {
struct InputFile::Impl {
  VSILFILE* file = nullptr;
  ~Impl() {
    if (file != nullptr) VSIFCloseL(file);
  }
};

InputFile::InputFile(const std::filesystem::path& path)
    : name_(path.string()), impl_(std::make_unique<Impl>()) {
  RequireOpenable(name_, "a model file", false);
  VSIStatBufL stat;
  if (VSIStatExL(name_.c_str(), &stat, VSI_STAT_EXISTS_FLAG | VSI_STAT_SIZE_FLAG) != 0) {
    throw InputError(name_, "", "no such file", "a model file");
  }
  const bool gzipped = path.extension() == ".gz";
  if (gzipped)
    most_bytes_ = std::max(limits::kExpandedBytes,
                           limits::kExpansion * static_cast<std::uint64_t>(stat.st_size));
  impl_->file = VSIFOpenL((gzipped ? "/vsigzip/" + name_ : name_).c_str(), "rb");
  if (impl_->file == nullptr) {
    throw InputError(name_, "", "a file that cannot be read", "read permission");
  }
}

InputFile::~InputFile() = default;

std::size_t InputFile::Read(char* buffer, std::size_t size) {
  const std::size_t count = VSIFReadL(buffer, 1, size, impl_->file);
  bytes_read_ += count;
  if (bytes_read_ > most_bytes_) {
    throw InputError(
        name_,
        "limit",
        "a file that grows to more than " + std::to_string(most_bytes_ >> 20) + " MB when unpacked",
        "at most " + std::to_string(limits::kExpansion) +
            " times its size (gunzip it to have it read)");
  }
  return count;
}

std::string InputFile::ReadAll() {
  std::string text;
  constexpr std::size_t kChunk = std::size_t{1} << 20;
  for (;;) {
    const std::size_t old_size = text.size();
    text.resize(old_size + kChunk);
    const std::size_t count = Read(text.data() + old_size, kChunk);
    text.resize(old_size + count);
    if (count == 0) return text;
  }
}

}  // namespace ridgeline
