// SPDX-License-Identifier: Apache-2.0
#include "city/read_source.h"

#include <algorithm>
#include <array>
#include <string>

#include "base/error.h"
#include "city/input_file.h"
#include "city/read_citygml.h"

namespace ridgeline {
namespace {

// ".gml" of "tile.gml.gz".
std::string ModelExtension(const std::filesystem::path& path) {
  const std::filesystem::path name = path.extension() == ".gz" ? path.stem() : path;
  std::string extension = name.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(), [](unsigned char c) {
    return static_cast<char>(std::tolower(c));
  });
  return extension;
}

}  // namespace

bool LooksLikeModelFile(const std::filesystem::path& path) {
  static constexpr std::array kExtensions = {".gml", ".citygml", ".xml"};
  const std::string extension = ModelExtension(path);
  return std::find(kExtensions.begin(), kExtensions.end(), extension) != kExtensions.end();
}

SourceModel ReadSource(const std::filesystem::path& path) {
  InputFile file(path);
  return ReadCityGml(file);
}

}  // namespace ridgeline
