// SPDX-License-Identifier: Apache-2.0
#include "city/open_raster.h"

#include <filesystem>
#include <system_error>

#include "base/error.h"

namespace ridgeline {
namespace fs = std::filesystem;

GdalDatasetPtr OpenRaster(const std::string& file, const std::string& expected) {
  std::error_code error;
  // GDAL's virtual files are no files here; some formats are folders.
  const fs::file_status status = fs::status(file, error);
  if (fs::exists(status) && !fs::is_regular_file(status) && !fs::is_directory(status)) {
    throw InputError(file, "", "a pipe or a device", expected);
  }
  GDALAllRegister();
  GdalDatasetPtr dataset(GDALDataset::Open(file.c_str(), GDAL_OF_RASTER | GDAL_OF_READONLY));
  if (dataset == nullptr || dataset->GetRasterCount() < 1) {
    throw InputError(file, "", "a file that GDAL cannot open as a raster", expected);
  }
  return dataset;
}

}  // namespace ridgeline
