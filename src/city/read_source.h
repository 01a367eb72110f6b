// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "city/source_model.h"

namespace ridgeline {

// Whether a folder's file is taken for a model: *.gml, *.citygml, *.jsonl, *.obj, *.ply, and those
// *.xml and *.json that say CityModel or CityJSON near their beginning; all also with .gz.
bool LooksLikeModelFile(const std::filesystem::path& path);

// Reads a model file of any known format, told by its name, in its own coordinates. Throws
// InputError for a file that is missing, damaged, or of no known format.
SourceModel ReadSource(const std::filesystem::path& path);

}  // namespace ridgeline
