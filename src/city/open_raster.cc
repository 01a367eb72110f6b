// SPDX-License-Identifier: Apache-2.0
#include "city/open_raster.h"

#include <string>

#include "base/error.h"
#include "city/format/openable.h"
#include "city/vrt_sources.h"

namespace ridgeline {
namespace {

// GDAL finds a row of these by the rows before it, and each of those that fails by those before it,
// in a number of steps that doubles with every row (GDAL 3.6): rows are read from the first one on,
// up to the first that fails.
bool IsRowByRow(GDALDataset& dataset) {
  const std::string driver = dataset.GetDriver()->GetDescription();
  return driver == "AAIGrid" || driver == "GRASSASCIIGrid" || driver == "ISG";
}

void RequireAllRows(GDALDataset& dataset, const std::string& file) {
  for (int y = 0; y < dataset.GetRasterYSize(); ++y) {
    double first = 0.0;  // of the row, which is read whole
    if (dataset.GetRasterBand(1)->RasterIO(
            GF_Read, 0, y, 1, 1, &first, 1, 1, GDT_Float64, 0, 0) == CE_None) {
      continue;
    }
    throw InputError(file,
                     "row " + std::to_string(y),
                     "a row that ends early or holds something else than numbers",
                     std::to_string(dataset.GetRasterYSize()) + " rows of " +
                         std::to_string(dataset.GetRasterXSize()) + " heights");
  }
}

}  // namespace

GdalDatasetPtr OpenRaster(const std::string& file, const std::string& expected) {
  RequireOpenable(file, expected, true);
  CheckVrtSources(file);
  GDALAllRegister();
  GdalDatasetPtr dataset(GDALDataset::Open(file.c_str(), GDAL_OF_RASTER | GDAL_OF_READONLY));
  if (dataset == nullptr || dataset->GetRasterCount() < 1) {
    throw InputError(file, "", "a file that GDAL cannot open as a raster", expected);
  }
  if (IsRowByRow(*dataset)) RequireAllRows(*dataset, file);
  return dataset;
}

}  // namespace ridgeline
