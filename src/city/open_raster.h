// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "base/gdal_handles.h"

namespace ridgeline {

// Opens any GDAL raster of one band or more for reading. Throws InputError for a pipe or a device,
// which GDAL would read for ever, and for what it cannot open, with `expected` in the message.
GdalDatasetPtr OpenRaster(const std::string& file, const std::string& expected);

}  // namespace ridgeline
