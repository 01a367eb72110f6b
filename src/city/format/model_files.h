// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "city/city_region.h"

namespace ridgeline {

struct ModelFiles {
  std::vector<std::filesystem::path> files;
  std::vector<std::string> warnings;  // of servers, and what was passed over in folders
};

// The files that paths stand for: a folder means every model file in it and below it, by name (the
// rest is counted in a warning); an address on a web server its local copy (web_file.h), a template
// of addresses the tiles around the region. Throws InputError for a folder without any, and where a
// server has none or fails.
ModelFiles ListModelFiles(const std::vector<std::filesystem::path>& paths,
                          const std::optional<CityRegion>& region = {});

}  // namespace ridgeline
