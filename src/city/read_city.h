// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <vector>

#include "city/city_model.h"
#include "city/city_options.h"

namespace ridgeline {

// Reads model files (folders: every model file in them) into one model: the formats of
// format/formats.h, and stores of WriteCityStore. Throws
// InputError for a missing, truncated or unreadable file, for files in different systems, and for a
// model without any building that has a volume. What is dropped or repaired is named in
// CityModel::warnings.
CityModel ReadCity(const std::vector<std::filesystem::path>& paths, const CityOptions& options);

// The system that ReadCity puts the model in; horizontal_epsg 0: the model names none. Reads the
// first file only, of a store its table of contents. Throws InputError as ReadCity.
Crs ReadCityCrs(const std::vector<std::filesystem::path>& paths, const CityOptions& options);

}  // namespace ridgeline
