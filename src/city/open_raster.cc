// SPDX-License-Identifier: Apache-2.0
#include "city/open_raster.h"

#include "base/error.h"
#include "city/format/openable.h"
#include "city/vrt_sources.h"

namespace ridgeline {

GdalDatasetPtr OpenRaster(const std::string& file, const std::string& expected) {
  RequireOpenable(file, expected, true);
  CheckVrtSources(file);
  GDALAllRegister();
  GdalDatasetPtr dataset(GDALDataset::Open(file.c_str(), GDAL_OF_RASTER | GDAL_OF_READONLY));
  if (dataset == nullptr || dataset->GetRasterCount() < 1) {
    throw InputError(file, "", "a file that GDAL cannot open as a raster", expected);
  }
  return dataset;
}

}  // namespace ridgeline
