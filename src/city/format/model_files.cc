// SPDX-License-Identifier: Apache-2.0
#include "city/format/model_files.h"

#include <algorithm>
#include <map>
#include <string>

#include "base/error.h"
#include "city/format/formats.h"
#include "city/format/web_file.h"

namespace ridgeline {
namespace fs = std::filesystem;
namespace {

// How far from the places asked for tiles of a server are wanted [m]: what is farther is rarely
// seen.
constexpr double kTileReachM = 500.0;

// Copies of the file at an address, or of those tiles of a template that the server has.
void AddWebFiles(const std::string& address,
                 const std::optional<CityRegion>& region,
                 ModelFiles& listed) {
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
    listed.files.push_back(file->path);
    if (!file->warning.empty()) listed.warnings.push_back(file->warning);
  }
  if (found == 0) {
    throw InputError(addresses.front(),
                     "",
                     addresses.size() == 1
                         ? "no such file on the server"
                         : "none of " + std::to_string(addresses.size()) + " tiles on the server",
                     "the address of a model file");
  }
  if (found < addresses.size()) {
    listed.warnings.push_back(address + ": " + std::to_string(addresses.size() - found) + " of " +
                              std::to_string(addresses.size()) + " tiles are not on the server");
  }
}

// "3 *.json, 1 *.tif".
std::string CountsText(const std::map<std::string, std::size_t>& counts) {
  std::string text;
  for (const auto& [kind, count] : counts) {
    text += (text.empty() ? "" : ", ") + std::to_string(count) + " " + kind;
  }
  return text;
}

std::string KindOf(const fs::directory_entry& entry) {
  if (entry.is_directory()) return "links to folders";
  if (!entry.is_regular_file()) return "files that are no regular ones";
  const std::string extension = entry.path().extension().string();
  return extension.empty() ? "files without an extension" : "*" + extension;
}

void AddFolder(const fs::path& folder, ModelFiles& listed) {
  std::vector<fs::path> found;
  std::map<std::string, std::size_t> passed_over;
  try {
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder)) {
      if (entry.is_directory() && !entry.is_symlink()) continue;
      if (entry.is_regular_file() && IsModelFile(entry.path())) {
        found.push_back(entry.path());
      } else {
        ++passed_over[KindOf(entry)];
      }
    }
  } catch (const fs::filesystem_error& e) {
    throw InputError(folder.string(),
                     "",
                     e.code().message() + " (" + e.path1().string() + ")",
                     "a folder that can be read");
  }
  const std::string rest = CountsText(passed_over);
  if (found.empty()) {
    throw InputError(folder.string(),
                     "",
                     "a folder without model files" + (rest.empty() ? "" : " (" + rest + ")"),
                     ModelFilePatterns());
  }
  if (!rest.empty()) {
    listed.warnings.push_back(folder.string() + ": not city models, passed over: " + rest);
  }
  std::sort(found.begin(), found.end());
  listed.files.insert(listed.files.end(), found.begin(), found.end());
}

}  // namespace

ModelFiles ListModelFiles(const std::vector<fs::path>& paths,
                          const std::optional<CityRegion>& region) {
  ModelFiles listed;
  for (const fs::path& path : paths) {
    std::error_code error;
    if (IsWebAddress(path)) {
      AddWebFiles(path.string(), region, listed);
    } else if (fs::is_directory(path, error)) {
      AddFolder(path, listed);
    } else {
      listed.files.push_back(path);
    }
  }
  return listed;
}

}  // namespace ridgeline
