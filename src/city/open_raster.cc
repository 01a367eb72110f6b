// SPDX-License-Identifier: Apache-2.0
#include "city/open_raster.h"

#include <gdal_priv.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.h"
#include "base/limits.h"
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
    if (dataset.GetRasterBand(1)->RasterIO(GF_Read, 0, y, 1, 1, &first, 1, 1, GDT_Float64, 0, 0) ==
        CE_None) {
      continue;
    }
    throw InputError(file,
                     "row " + std::to_string(y),
                     "a row that ends early or holds something else than numbers",
                     std::to_string(dataset.GetRasterYSize()) + " rows of " +
                         std::to_string(dataset.GetRasterXSize()) + " heights");
  }
}

// Names of all drivers that read files: those of map servers would ask a server that a file names.
std::vector<const char*> DriversOfFiles() {
  static constexpr std::array<std::string_view, 12> kServers = {"WMS",
                                                                "WMTS",
                                                                "WCS",
                                                                "OGCAPI",
                                                                "HTTP",
                                                                "STACIT",
                                                                "STACTA",
                                                                "EEDA",
                                                                "EEDAI",
                                                                "PLMOSAIC",
                                                                "NGW",
                                                                "PostGISRaster"};
  std::vector<const char*> names;
  GDALDriverManager& manager = *GetGDALDriverManager();
  for (int i = 0; i < manager.GetDriverCount(); ++i) {
    const char* const name = manager.GetDriver(i)->GetDescription();
    if (std::find(kServers.begin(), kServers.end(), name) == kServers.end()) names.push_back(name);
  }
  names.push_back(nullptr);
  return names;
}

// GDAL reads a block as a whole, be it for a single cell.
void CheckBlocks(GDALDataset& dataset, const std::string& file) {
  int columns = 0;
  int rows = 0;
  dataset.GetRasterBand(1)->GetBlockSize(&columns, &rows);
  if (std::int64_t{columns} * rows <= limits::kRasterCells) return;
  throw InputError(file,
                   "limit",
                   "cells in blocks of " + std::to_string(columns) + " x " + std::to_string(rows),
                   "blocks of at most " + std::to_string(limits::kRasterCells) +
                       " cells (gdal_translate -co TILED=YES makes them)");
}

}  // namespace

std::optional<std::array<double, 6>> GeoTransformOf(GDALDataset& dataset, const std::string& file) {
  std::array<double, 6> g{};
  if (dataset.GetGeoTransform(g.data()) != CE_None) return std::nullopt;
  const bool is_finite = std::all_of(g.begin(), g.end(), [](double v) { return std::isfinite(v); });
  const double area = std::abs(g[1] * g[5] - g[2] * g[4]);
  if (is_finite && area > 0.0 && std::isfinite(area)) return g;
  std::ostringstream text;
  text << g[0];
  for (std::size_t i = 1; i < g.size(); ++i) text << ", " << g[i];
  throw InputError(file,
                   "geotransform",
                   text.str() + ", which makes cells of no size",
                   "where the raster lies (gdal_edit.py -a_ullr corrects it)");
}

GdalDatasetPtr OpenRaster(const std::string& file, const std::string& expected) {
  RequireOpenable(file, expected, true);
  CheckVrtSources(file);
  GDALAllRegister();
  GdalDatasetPtr dataset(
      GDALDataset::Open(file.c_str(), GDAL_OF_RASTER | GDAL_OF_READONLY, DriversOfFiles().data()));
  if (dataset == nullptr || dataset->GetRasterCount() < 1) {
    throw InputError(file, "", "a file that GDAL cannot open as a raster", expected);
  }
  CheckBlocks(*dataset, file);
  if (IsRowByRow(*dataset)) RequireAllRows(*dataset, file);
  return dataset;
}

}  // namespace ridgeline
