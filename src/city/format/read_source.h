// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "city/city_region.h"
#include "city/source_model.h"

namespace ridgeline {

// Whether a folder's file is taken for a model: *.gml, *.citygml, *.jsonl, *.obj, *.ply, and those
// *.xml and *.json that say CityModel or CityJSON near their beginning; all also with .gz.
bool LooksLikeModelFile(const std::filesystem::path& path);

// The files that paths stand for: a folder means every model file in it and below it, by name; an
// address on a web server its local copy (web_file.h), a template of addresses the tiles around the
// region. Throws InputError for a folder without any, and where a server has none or fails.
//
// @param warnings  Gets what is to be known of servers; may be null.
std::vector<std::filesystem::path> ListModelFiles(const std::vector<std::filesystem::path>& paths,
                                                  const std::optional<CityRegion>& region = {},
                                                  std::vector<std::string>* warnings = nullptr);

// Reads a model file of any known format, told by its name, in its own coordinates. Throws
// InputError for a file that is missing, damaged, or of no known format.
//
// @param region  Of a store (*.gpkg) only these buildings are read; other formats are read whole.
SourceModel ReadSource(const std::filesystem::path& path,
                       const std::optional<CityRegion>& region = {});

}  // namespace ridgeline
