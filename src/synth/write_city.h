// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "city/terrain.h"
#include "synth/town.h"

namespace ridgeline {

// Writes the town as CityGML 2.0, LoD2, in the manner of the German surveying authorities (AdV):
// solids with boundary surfaces, building parts, external references. Throws InputError if the file
// cannot be written.
void WriteCityGml(const Town& town, const std::filesystem::path& path);

// Writes a height grid as a GeoTIFF (float32, DEFLATE) in the town's CRS; world heights.
// The pixel centres are the grid points.
void WriteDtm(const Town& town, const HeightGrid& grid, const std::filesystem::path& path);

}  // namespace ridgeline
