// SPDX-License-Identifier: Apache-2.0
#include <gdal_priv.h>
#include <ogr_spatialref.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.h"
#include "base/gdal_handles.h"
#include "base/limits.h"
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

// Of large rasters every so manieth row, each with the blocks that it crosses.
int RowStep(GDALDataset& dataset, const RasterInfo& info) {
  constexpr double kMostCells = 2e8;
  const double cells = static_cast<double>(info.columns) * info.rows;
  if (cells <= kMostCells) return 1;
  int block_columns = 0;
  int block_rows = 0;
  dataset.GetRasterBand(1)->GetBlockSize(&block_columns, &block_rows);
  if (static_cast<double>(info.columns) * block_rows > static_cast<double>(limits::kRasterCells)) {
    throw InputError(info.file,
                     "limit",
                     "rows of " + std::to_string(info.columns) + " cells in blocks of " +
                         std::to_string(block_rows) + " rows",
                     "at most " + std::to_string(limits::kRasterCells) + " cells together");
  }
  return static_cast<int>(
      std::min(std::ceil(cells * block_rows / kMostCells), static_cast<double>(info.rows)));
}

void ReadValues(GDALDataset& dataset, RasterInfo& info) {
  info.row_step = RowStep(dataset, info);
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
  const auto transform = GeoTransformOf(*dataset, info.file);
  info.georeferenced = transform.has_value();
  ReadMetadata(*dataset, info);
  if (!info.georeferenced) return info;
  const std::array<double, 6>& g = *transform;
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
