// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>
#include <string>

#include "base/gdal_handles.h"

namespace ridgeline {

// Opens any GDAL raster of one band or more for reading. Throws InputError for a pipe or a device,
// which GDAL would read for ever, for what it cannot open, with `expected` in the message, and for
// cells in blocks that are too large to be read piece by piece. Descriptions of map servers are not
// opened.
GdalDatasetPtr OpenRaster(const std::string& file, const std::string& expected);

// Where the cells lie, as GDAL has it; nullopt if the raster does not say. Throws InputError for
// numbers that give no cells.
std::optional<std::array<double, 6>> GeoTransformOf(GDALDataset& dataset, const std::string& file);

}  // namespace ridgeline
