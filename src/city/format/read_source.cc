// SPDX-License-Identifier: Apache-2.0
#include "city/format/read_source.h"

#include <algorithm>
#include <array>
#include <string>

#include "base/error.h"
#include "city/format/input_file.h"
#include "city/format/read_citygml.h"
#include "city/format/read_cityjson.h"
#include "city/format/read_obj.h"
#include "city/format/web_file.h"
#include "city/store/city_store.h"

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

// How far from the places asked for tiles of a server are wanted [m]: what is farther is rarely
// seen.
constexpr double kTileReachM = 500.0;

// Copies of the file at an address, or of those tiles of a template that the server has.
void AddWebFiles(const std::string& address,
                 const std::optional<CityRegion>& region,
                 std::vector<fs::path>& files,
                 std::vector<std::string>* warnings) {
  std::vector<std::string> addresses = {address};
  if (IsTileAddress(address)) {
    if (!region) {
      throw InputError(
          "--model",
          "",
          address + " without a place",
          "a prior in a known system (--crs), or an address without {east} and {north}");
    }
    Eigen::AlignedBox2d box = region->positions;
    box.min().array() -= kTileReachM;
    box.max().array() += kTileReachM;
    addresses = TileAddresses(address, box);
  }
  std::size_t found = 0;
  for (const std::string& tile : addresses) {
    const std::optional<WebFile> file = FetchWebFile(tile);
    if (!file) continue;
    ++found;
    files.push_back(file->path);
    if (warnings != nullptr && !file->warning.empty()) warnings->push_back(file->warning);
  }
  if (found == 0) {
    throw InputError(addresses.front(),
                     "",
                     addresses.size() == 1
                         ? "no such file on the server"
                         : "none of " + std::to_string(addresses.size()) + " tiles on the server",
                     "the address of a model file");
  }
  if (warnings != nullptr && found < addresses.size()) {
    warnings->push_back(address + ": " + std::to_string(addresses.size() - found) + " of " +
                        std::to_string(addresses.size()) + " tiles are not on the server");
  }
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

std::vector<fs::path> ListModelFiles(const std::vector<fs::path>& paths,
                                     const std::optional<CityRegion>& region,
                                     std::vector<std::string>* warnings) {
  std::vector<fs::path> files;
  for (const fs::path& path : paths) {
    std::error_code error;
    if (IsWebAddress(path)) {
      AddWebFiles(path.string(), region, files, warnings);
      continue;
    }
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
