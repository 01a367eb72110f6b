// SPDX-License-Identifier: Apache-2.0
#include <gdal_priv.h>
#include <ogr_spatialref.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <string_view>
#include <vector>

#include "base/error.h"
#include "city/city_info.h"

namespace ridgeline {
namespace {

struct DatasetCloser {
  void operator()(GDALDataset* dataset) const { GDALClose(dataset); }
};

std::string CrsText(const OGRSpatialReference* srs) {
  if (srs == nullptr || srs->IsEmpty()) return {};
  const char* const code = srs->GetAuthorityCode(nullptr);
  if (code != nullptr) return std::string("EPSG:") + code;
  return srs->GetName() != nullptr ? srs->GetName() : "unnamed";
}

void ReadMetadata(GDALDataset& dataset, RasterInfo& info) {
  constexpr std::string_view kPrefix = "EXIF_";
  for (const char* domain : {"", "EXIF"}) {
    char** const items = dataset.GetMetadata(domain);
    for (char** item = items; item != nullptr && *item != nullptr; ++item) {
      const std::string_view text = *item;
      const std::size_t equals = text.find('=');
      if (!text.starts_with(kPrefix) || equals == std::string_view::npos) continue;
      info.exif.emplace(text.substr(kPrefix.size(), equals - kPrefix.size()),
                        text.substr(equals + 1));
    }
  }
  info.has_xmp = dataset.GetMetadata("xml:XMP") != nullptr;
}

void ReadValues(GDALDataset& dataset, RasterInfo& info) {
  GDALRasterBand& band = *dataset.GetRasterBand(1);
  int has_nodata = 0;
  const double nodata = band.GetNoDataValue(&has_nodata);
  std::vector<double> row(static_cast<std::size_t>(info.columns));
  double low = std::numeric_limits<double>::infinity();
  double high = -low;
  std::size_t known = 0;
  for (int r = 0; r < info.rows; ++r) {
    const CPLErr error = band.RasterIO(
        GF_Read, 0, r, info.columns, 1, row.data(), info.columns, 1, GDT_Float64, 0, 0, nullptr);
    if (error != CE_None) {
      throw InputError(info.file,
                       "row " + std::to_string(r),
                       "cells that cannot be read",
                       "a whole raster (was the download cut off?)");
    }
    for (const double value : row) {
      if (!std::isfinite(value) || (has_nodata != 0 && value == nodata)) continue;
      low = std::min(low, value);
      high = std::max(high, value);
      ++known;
    }
  }
  const double scale = band.GetScale();
  const double offset = band.GetOffset();
  info.known_share = static_cast<double>(known) / (static_cast<double>(info.columns) * info.rows);
  if (known == 0) return;
  info.min_value = low * scale + offset;
  info.max_value = high * scale + offset;
}

}  // namespace

RasterInfo DescribeRaster(const std::filesystem::path& path) {
  GDALAllRegister();
  RasterInfo info;
  info.file = path.string();
  CPLPushErrorHandler(CPLQuietErrorHandler);
  const std::unique_ptr<GDALDataset, DatasetCloser> dataset(
      GDALDataset::Open(info.file.c_str(), GDAL_OF_RASTER | GDAL_OF_READONLY));
  CPLPopErrorHandler();
  if (dataset == nullptr || dataset->GetRasterCount() < 1) {
    throw InputError(
        info.file, "", "a file that GDAL cannot open as a raster", "a picture or a terrain model");
  }
  info.driver = dataset->GetDriverName();
  info.columns = dataset->GetRasterXSize();
  info.rows = dataset->GetRasterYSize();
  info.bands = dataset->GetRasterCount();
  info.crs = CrsText(dataset->GetSpatialRef());
  double g[6] = {};
  info.georeferenced = dataset->GetGeoTransform(g) == CE_None;
  ReadMetadata(*dataset, info);
  if (!info.georeferenced) return info;
  info.spacing = {std::hypot(g[1], g[4]), std::hypot(g[2], g[5])};
  const auto corner = [&](double column, double row) {
    return Eigen::Vector2d(g[0] + column * g[1] + row * g[2], g[3] + column * g[4] + row * g[5]);
  };
  info.lowest = corner(0, 0);
  info.highest = info.lowest;
  for (const double column : {0.0, static_cast<double>(info.columns)}) {
    for (const double row : {0.0, static_cast<double>(info.rows)}) {
      info.lowest = info.lowest.cwiseMin(corner(column, row));
      info.highest = info.highest.cwiseMax(corner(column, row));
    }
  }
  ReadValues(*dataset, info);
  return info;
}

}  // namespace ridgeline
