// SPDX-License-Identifier: Apache-2.0
#include "city/srs_import.h"

#include "base/error.h"
#include "base/gdal_handles.h"

namespace ridgeline {

std::unique_ptr<OGRSpatialReference> ImportEpsg(int epsg) {
  auto srs = std::make_unique<OGRSpatialReference>();
  const QuietGdal quiet;
  if (srs->importFromEPSG(epsg) != OGRERR_NONE) return nullptr;
  srs->SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
  return srs;
}

std::unique_ptr<OGRSpatialReference> ImportEpsgOrThrow(int epsg, const std::string& file) {
  std::unique_ptr<OGRSpatialReference> srs = ImportEpsg(epsg);
  if (srs == nullptr) {
    throw InputError(file,
                     "CRS",
                     "EPSG:" + std::to_string(epsg) + ", unknown to PROJ",
                     "a known EPSG code (--model-crs overrides the file's)");
  }
  return srs;
}

}  // namespace ridgeline
