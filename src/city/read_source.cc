// SPDX-License-Identifier: Apache-2.0
#include "city/read_source.h"

#include <algorithm>
#include <array>
#include <string>

#include "base/error.h"
#include "city/city_store.h"
#include "city/input_file.h"
#include "city/read_citygml.h"
#include "city/read_cityjson.h"
#include "city/read_obj.h"

namespace ridgeline {
namespace fs = std::filesystem;
namespace {

// ".gml" of "tile.gml.gz".
std::string ModelExtension(const fs::path& path) {
  const fs::path name = path.extension() == ".gz" ? path.stem() : path;
  std::string extension = name.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(), [](unsigned char c) {
    return static_cast<char>(std::tolower(c));
  });
  return extension;
}

}  // namespace

bool LooksLikeModelFile(const fs::path& path) {
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

std::vector<fs::path> ListModelFiles(const std::vector<fs::path>& paths) {
  std::vector<fs::path> files;
  for (const fs::path& path : paths) {
    std::error_code error;
    if (!fs::is_directory(path, error)) {
      files.push_back(path);
      continue;
    }
    std::vector<fs::path> found;
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(path)) {
      if (entry.is_regular_file() && LooksLikeModelFile(entry.path())) {
        found.push_back(entry.path());
      }
    }
    if (found.empty())
      throw InputError(path.string(),
                       "",
                       "a folder without model files",
                       "*.gml, *.xml, *.json, *.jsonl, *.obj or *.ply");
    std::sort(found.begin(), found.end());
    files.insert(files.end(), found.begin(), found.end());
  }
  return files;
}

SourceModel ReadSource(const fs::path& path, const std::optional<CityRegion>& region) {
  InputFile file(path);
  const std::string extension = ModelExtension(path);
  if (extension == ".gpkg") return ReadCityStore(path, region);
  if (extension == ".json" || extension == ".jsonl" || extension == ".cityjson") {
    return ReadCityJson(file);
  }
  if (extension == ".obj") return ReadObj(file);
  if (extension == ".ply") return ReadPly(file);
  return ReadCityGml(file);
}

}  // namespace ridgeline
