// SPDX-License-Identifier: Apache-2.0
#include "city/read_source.h"

#include <algorithm>
#include <array>
#include <string>

#include "city/input_file.h"
#include "city/read_citygml.h"
#include "city/read_cityjson.h"
#include "city/read_obj.h"

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
  static constexpr std::array kModels = {".gml", ".citygml", ".jsonl", ".obj", ".ply"};
  static constexpr std::array kPerhaps = {".xml", ".json"};
  const std::string extension = ModelExtension(path);
  if (std::find(kModels.begin(), kModels.end(), extension) != kModels.end()) return true;
  if (std::find(kPerhaps.begin(), kPerhaps.end(), extension) == kPerhaps.end()) return false;
  // Many other files are JSON or XML; a city model names itself early on.
  std::string head(4096, '\0');
  head.resize(InputFile(path).Read(head.data(), head.size()));
  return head.find("CityModel") != std::string::npos || head.find("CityJSON") != std::string::npos;
}

SourceModel ReadSource(const std::filesystem::path& path) {
  InputFile file(path);
  const std::string extension = ModelExtension(path);
  if (extension == ".json" || extension == ".jsonl" || extension == ".cityjson") {
    return ReadCityJson(file);
  }
  if (extension == ".obj") return ReadObj(file);
  if (extension == ".ply") return ReadPly(file);
  return ReadCityGml(file);
}

}  // namespace ridgeline
