// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <ogr_spatialref.h>

#include <memory>
#include <string>

namespace ridgeline {

// GDAL's object of an EPSG code with east (longitude) first; nullptr: PROJ does not know the code.
std::unique_ptr<OGRSpatialReference> ImportEpsg(int epsg);

// Throws InputError(file, "CRS", ...) for a code that PROJ does not know.
std::unique_ptr<OGRSpatialReference> ImportEpsgOrThrow(int epsg, const std::string& file);

}  // namespace ridgeline
