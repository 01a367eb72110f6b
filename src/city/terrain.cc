// SPDX-License-Identifier: Apache-2.0
#include "city/terrain.h"

#include <gdal_priv.h>
#include <gdal_utils.h>
#include <ogr_spatialref.h>

#include <cmath>
#include <limits>
#include <string>

#include "base/error.h"
#include "city/crs.h"
#include "city/format/web_file.h"

namespace ridgeline {
namespace {

// Heights outside this range are fill values that the raster does not declare.
constexpr double kLowestHeight = -1000.0;
constexpr double kHighestHeight = 9000.0;

struct DatasetCloser {
  void operator()(GDALDataset* dataset) const { GDALClose(dataset); }
};
using DatasetPtr = std::unique_ptr<GDALDataset, DatasetCloser>;

// GDAL's messages are not for the user: ours say which file and what to do.
class QuietGdal {
 public:
  QuietGdal() { CPLPushErrorHandler(CPLQuietErrorHandler); }
  ~QuietGdal() { CPLPopErrorHandler(); }
  QuietGdal(const QuietGdal&) = delete;
  QuietGdal& operator=(const QuietGdal&) = delete;
};

DatasetPtr Open(const std::string& file) {
  GDALAllRegister();
  DatasetPtr dataset(GDALDataset::Open(file.c_str(), GDAL_OF_RASTER | GDAL_OF_READONLY));
  if (dataset == nullptr || dataset->GetRasterCount() < 1) {
    throw InputError(file,
                     "",
                     "a file that GDAL cannot open as a raster",
                     "a terrain model such as a GeoTIFF or a VRT");
  }
  return dataset;
}

// The file itself, or the copy of one on a web server.
std::string LocalFile(const std::string& file, std::vector<std::string>& warnings) {
  if (!IsWebAddress(file)) return file;
  const std::optional<WebFile> copy = FetchWebFile(file);
  if (!copy) throw InputError(file, "", "no such file on the server", "a terrain model");
  if (!copy->warning.empty()) warnings.push_back(copy->warning);
  return copy->path.string();
}

std::string NameOf(const OGRSpatialReference& srs) {
  const char* const code = srs.GetAuthorityCode(nullptr);
  if (code != nullptr) return std::string("EPSG:") + code;
  return srs.GetName() != nullptr ? srs.GetName() : "an unnamed system";
}

void CheckCrs(GDALDataset& dataset,
              const Crs& model_crs,
              const std::string& file,
              std::vector<std::string>& warnings) {
  const OGRSpatialReference* const found = dataset.GetSpatialRef();
  if (found == nullptr || found->IsEmpty() || found->IsLocal()) {
    warnings.push_back(file + ": the raster names no reference system; taken to be in " +
                       CrsName(model_crs) + ", the model's");
    return;
  }
  if (model_crs.horizontal_epsg == 0) return;
  OGRSpatialReference horizontal(*found);
  int vertical = 0;
  if (horizontal.IsCompound()) {
    const char* const code = horizontal.GetAuthorityCode("COMPD_CS|VERT_CS");
    vertical = code != nullptr ? std::atoi(code) : 0;
    horizontal.StripVertical();
  }
  OGRSpatialReference expected;
  expected.importFromEPSG(model_crs.horizontal_epsg);
  constexpr const char* kCriteria[] = {"CRITERION=EQUIVALENT_EXCEPT_AXIS_ORDER_GEOGCRS",
                                       "IGNORE_DATA_AXIS_TO_SRS_AXIS_MAPPING=YES",
                                       nullptr};
  const char* const code = horizontal.GetAuthorityCode(nullptr);
  const bool same_code = code != nullptr && std::atoi(code) == model_crs.horizontal_epsg;
  if (!same_code && horizontal.IsSame(&expected, kCriteria) != TRUE) {
    throw InputError(
        file,
        "CRS",
        NameOf(horizontal),
        CrsName({model_crs.horizontal_epsg, 0}) + " (the model's; gdalwarp -t_srs moves it)");
  }
  if (vertical != 0 && model_crs.vertical_epsg != 0 && vertical != model_crs.vertical_epsg) {
    warnings.push_back(file + ": heights in EPSG:" + std::to_string(vertical) +
                       ", the model's in EPSG:" + std::to_string(model_crs.vertical_epsg) +
                       "; they are used as they are");
  }
}

struct GeoTransform {
  double c[6] = {0.0, 1.0, 0.0, 0.0, 0.0, 1.0};
};

// Whether columns run east and rows south with square cells.
bool IsSquareNorthUp(const GeoTransform& g) {
  constexpr double kRelative = 1e-6;
  return g.c[1] > 0.0 && g.c[5] < 0.0 && std::abs(g.c[1] + g.c[5]) < kRelative * g.c[1] &&
         std::abs(g.c[2]) < kRelative * g.c[1] && std::abs(g.c[4]) < kRelative * g.c[1];
}

// The raster on square cells, north up.
DatasetPtr Straighten(DatasetPtr dataset, const std::string& file) {
  GeoTransform g;
  if (dataset->GetGeoTransform(g.c) != CE_None) {
    throw InputError(file,
                     "geotransform",
                     "a raster that does not say where it lies",
                     "a georeferenced raster (or a world file beside it)");
  }
  if (IsSquareNorthUp(g)) return dataset;
  const double cell_area = std::abs(g.c[1] * g.c[5] - g.c[2] * g.c[4]);
  const std::string spacing = std::to_string(std::sqrt(cell_area));
  const char* arguments[] = {"-of",
                             "MEM",
                             "-r",
                             "bilinear",
                             "-ot",
                             "Float64",
                             "-dstnodata",
                             "nan",
                             "-tr",
                             spacing.c_str(),
                             spacing.c_str(),
                             nullptr};
  GDALWarpAppOptions* const options = GDALWarpAppOptionsNew(const_cast<char**>(arguments), nullptr);
  GDALDatasetH source = dataset.get();
  DatasetPtr warped(GDALDataset::FromHandle(GDALWarp("", nullptr, 1, &source, options, nullptr)));
  GDALWarpAppOptionsFree(options);
  if (warped == nullptr) {
    throw InputError(
        file, "geotransform", "a grid that cannot be turned north up", "square cells, north up");
  }
  return warped;
}

struct Window {
  int column = 0, row = 0, columns = 0, rows = 0;
};

// Cells whose centres are within the box, and one more on each side.
Window WindowOf(const GeoTransform& g,
                int width,
                int height,
                const Eigen::Vector2d& lower,
                const Eigen::Vector2d& upper) {
  const double spacing = g.c[1];
  const auto clamp = [](double value, int limit) {
    return static_cast<int>(std::min(std::max(value, 0.0), static_cast<double>(limit)));
  };
  const int first_column = clamp(std::floor((lower.x() - g.c[0]) / spacing - 0.5), width);
  const int end_column = clamp(std::ceil((upper.x() - g.c[0]) / spacing - 0.5) + 1.0, width);
  const int first_row = clamp(std::floor((g.c[3] - upper.y()) / spacing - 0.5), height);
  const int end_row = clamp(std::ceil((g.c[3] - lower.y()) / spacing - 0.5) + 1.0, height);
  return {first_column, first_row, end_column - first_column, end_row - first_row};
}

float LocalHeight(double value, bool has_nodata, double nodata, double origin_height) {
  const bool unknown = !std::isfinite(value) || (has_nodata && value == nodata) ||
                       value < kLowestHeight || value > kHighestHeight;
  return unknown ? std::numeric_limits<float>::quiet_NaN()
                 : static_cast<float>(value - origin_height);
}

HeightGrid ReadWindow(GDALDataset& dataset,
                      const GeoTransform& g,
                      const Window& window,
                      const Eigen::Vector3d& origin,
                      const std::string& file) {
  GDALRasterBand& band = *dataset.GetRasterBand(1);
  std::vector<double> row(static_cast<std::size_t>(window.columns));
  int has_nodata = 0;
  const double nodata = band.GetNoDataValue(&has_nodata);
  const double scale = band.GetScale();
  const double offset = band.GetOffset();

  HeightGrid grid;
  grid.spacing_m = g.c[1];
  grid.columns = window.columns;
  grid.rows = window.rows;
  const int last_row = window.row + window.rows - 1;
  grid.first =
      Eigen::Vector2d(g.c[0] + (window.column + 0.5) * g.c[1], g.c[3] + (last_row + 0.5) * g.c[5]) -
      origin.head<2>();
  grid.heights.reserve(row.size() * static_cast<std::size_t>(window.rows));
  for (int r = 0; r < window.rows; ++r) {
    const CPLErr error = band.RasterIO(GF_Read,
                                       window.column,
                                       last_row - r,
                                       window.columns,
                                       1,
                                       row.data(),
                                       window.columns,
                                       1,
                                       GDT_Float64,
                                       0,
                                       0,
                                       nullptr);
    if (error != CE_None) {
      throw InputError(file,
                       "row " + std::to_string(last_row - r),
                       "cells that cannot be read",
                       "a whole raster (was the download cut off?)");
    }
    for (const double value : row) {
      const bool is_nodata = has_nodata != 0 && value == nodata;
      grid.heights.push_back(
          LocalHeight(is_nodata ? value : value * scale + offset, is_nodata, nodata, origin.z()));
    }
  }
  return grid;
}

}  // namespace

std::optional<double> HeightGrid::HeightAt(const Eigen::Vector2d& xy) const {
  const double x = (xy.x() - first.x()) / spacing_m;
  const double y = (xy.y() - first.y()) / spacing_m;
  if (!(x >= 0.0 && y >= 0.0 && x <= columns - 1.0 && y <= rows - 1.0)) return std::nullopt;
  const int column = std::min(static_cast<int>(x), std::max(columns - 2, 0));
  const int row = std::min(static_cast<int>(y), std::max(rows - 2, 0));
  const double fx = x - column;
  const double fy = y - row;
  const auto at = [this](int c, int r) {
    return static_cast<double>(
        heights[static_cast<std::size_t>(r) * static_cast<std::size_t>(columns) +
                static_cast<std::size_t>(c)]);
  };
  // Values of weight zero are not asked: a point on a known line is known.
  const auto along_row = [&](int r) {
    if (fx == 0.0) return at(column, r);
    if (fx == 1.0) return at(column + 1, r);
    return (1.0 - fx) * at(column, r) + fx * at(column + 1, r);
  };
  double height = 0.0;
  if (fy == 0.0) {
    height = along_row(row);
  } else if (fy == 1.0) {
    height = along_row(row + 1);
  } else {
    height = (1.0 - fy) * along_row(row) + fy * along_row(row + 1);
  }
  if (!std::isfinite(height)) return std::nullopt;
  return height;
}

HeightGrid ReadDtm(const std::filesystem::path& path,
                   const CityModel& model,
                   const Eigen::Vector2d& lower,
                   const Eigen::Vector2d& upper,
                   double margin_m,
                   std::vector<std::string>& warnings) {
  const QuietGdal quiet;
  const std::string file = path.string();
  DatasetPtr dataset = Open(LocalFile(file, warnings));
  CheckCrs(*dataset, model.crs, file, warnings);
  dataset = Straighten(std::move(dataset), file);
  GeoTransform g;
  dataset->GetGeoTransform(g.c);
  const Eigen::Vector2d margin = Eigen::Vector2d::Constant(margin_m);
  const Eigen::Vector2d origin = model.origin_in_world.head<2>();
  const int width = dataset->GetRasterXSize();
  const int height = dataset->GetRasterYSize();
  const Eigen::Vector2d low_world = lower + origin - margin;
  const Eigen::Vector2d high_world = upper + origin + margin;
  const Eigen::Vector2d raster_low(g.c[0], g.c[3] + height * g.c[5]);
  const Eigen::Vector2d raster_high(g.c[0] + width * g.c[1], g.c[3]);
  const auto box_text = [](const Eigen::Vector2d& low, const Eigen::Vector2d& high) {
    const auto number = [](double v) {
      return std::to_string(static_cast<long long>(std::floor(v)));
    };
    return number(low.x()) + ".." + number(high.x()) + " E, " + number(low.y()) + ".." +
           number(high.y()) + " N";
  };
  const bool touches = (raster_low.array() <= high_world.array()).all() &&
                       (raster_high.array() >= low_world.array()).all();
  if (!touches) {
    throw InputError(file,
                     "extent",
                     box_text(raster_low, raster_high),
                     "terrain at " + box_text(low_world, high_world));
  }
  const Window window = WindowOf(g, width, height, low_world, high_world);
  if (window.columns <= 0 || window.rows <= 0) {
    throw InputError(file,
                     "extent",
                     box_text(raster_low, raster_high),
                     "terrain at " + box_text(low_world, high_world));
  }
  return ReadWindow(*dataset, g, window, model.origin_in_world, file);
}

}  // namespace ridgeline
