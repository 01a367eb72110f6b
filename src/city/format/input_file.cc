// SPDX-License-Identifier: Apache-2.0
#include "city/format/input_file.h"

#include <cpl_conv.h>
#include <cpl_vsi.h>

#include "base/error.h"

namespace ridgeline {

struct InputFile::Impl {
  VSILFILE* file = nullptr;
  ~Impl() {
    if (file != nullptr) VSIFCloseL(file);
  }
};

InputFile::InputFile(const std::filesystem::path& path)
    : name_(path.string()), impl_(std::make_unique<Impl>()) {
  VSIStatBufL stat;
  if (VSIStatExL(name_.c_str(), &stat, VSI_STAT_EXISTS_FLAG | VSI_STAT_NATURE_FLAG) != 0) {
    throw InputError(name_, "", "no such file", "a model file");
  }
  if (VSI_ISDIR(stat.st_mode)) throw InputError(name_, "", "a folder", "a model file");
  const bool gzipped = path.extension() == ".gz";
  impl_->file = VSIFOpenL((gzipped ? "/vsigzip/" + name_ : name_).c_str(), "rb");
  if (impl_->file == nullptr) {
    throw InputError(name_, "", "a file that cannot be read", "read permission");
  }
}

InputFile::~InputFile() = default;

std::size_t InputFile::Read(char* buffer, std::size_t size) {
  return VSIFReadL(buffer, 1, size, impl_->file);
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
