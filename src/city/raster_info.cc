// SPDX-License-Identifier: Apache-2.0
#include <gdal_priv.h>
#include <ogr_spatialref.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.h"
#include "base/gdal_handles.h"
#include "city/city_info.h"
#include "city/open_raster.h"
#include "city/raster_values.h"

namespace ridgeline {
namespace {

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

// Of large rasters every so manieth row.
void ReadValues(GDALDataset& dataset, RasterInfo& info) {
  constexpr double kMostCells = 1e8;
  const double cells = static_cast<double>(info.columns) * info.rows;
  info.row_step = static_cast<int>(std::ceil(cells / kMostCells));
  RasterValues values(dataset, info.file, 1.0);
  std::vector<double> row(static_cast<std::size_t>(info.columns));
  double low = std::numeric_limits<double>::infinity();
  double high = -low;
  std::size_t known = 0;
  std::size_t read = 0;
  for (int r = 0; r < info.rows; r += info.row_step) {
    values.ReadRow(0, r, row);
    read += row.size();
    for (const double value : row) {
      if (std::isnan(value)) continue;
      low = std::min(low, value);
      high = std::max(high, value);
      ++known;
    }
  }
  info.warnings = values.Warnings();
  info.known_share = static_cast<double>(known) / static_cast<double>(read);
  if (known == 0) return;
  info.min_value = low;
  info.max_value = high;
}

// What ReadDtm would say of it.
void JudgeTerrain(GDALDataset& dataset, RasterInfo& info) {
  try {
    CheckIsTerrain(dataset, info.file);
  } catch (const InputError& e) {
    info.warnings.push_back(std::string("no terrain model: ") + e.what());
  }
}

}  // namespace

RasterInfo DescribeRaster(const std::filesystem::path& path) {
  RasterInfo info;
  info.file = path.string();
  const QuietGdal quiet;
  const GdalDatasetPtr dataset = OpenRaster(info.file, "a picture or a terrain model");
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
  info.unit = dataset->GetRasterBand(1)->GetUnitType();
  ReadValues(*dataset, info);
  JudgeTerrain(*dataset, info);
  return info;
}

}  // namespace ridgeline
