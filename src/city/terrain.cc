// SPDX-License-Identifier: Apache-2.0
#include "city/terrain.h"

#include <gdal_priv.h>
#include <gdal_utils.h>
#include <ogr_spatialref.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <utility>

#include "base/error.h"
#include "base/gdal_handles.h"
#include "base/limits.h"
#include "city/box_text.h"
#include "city/crs.h"
#include "city/format/web_file.h"
#include "city/open_raster.h"
#include "city/raster_values.h"
#include "city/units.h"

namespace ridgeline {
namespace {

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

// Where a raster's cells are in relation to the model.
struct RasterSystem {
  bool moves = false;  // into the model's system: it is in feet, which models are moved from too
  OGRSpatialReference horizontal;
  double metres_per_unit = 1.0;
  LengthUnit height_unit;
};

// The unit of the heights: the band's own, else the vertical system's, else the horizontal one's.
LengthUnit UnitOfHeights(GDALDataset& dataset,
                         const OGRSpatialReference* system,
                         const std::string& file,
                         std::vector<std::string>& warnings) {
  LengthUnit unit;
  std::string source;
  const std::string of_band = dataset.GetRasterBand(1)->GetUnitType();
  if (!of_band.empty() && of_band != "unknown") {
    const std::optional<double> metres = MetresPerUnit(of_band);
    if (!metres) {
      throw InputError(
          file, "unit", "\"" + of_band + "\"", "heights in a unit of length such as m or ft");
    }
    unit = {*metres, of_band};
    source = "the band's unit";
  } else if (system != nullptr) {
    const char* name = nullptr;
    if (system->IsCompound() == TRUE) {
      unit.metres = system->GetTargetLinearUnits("COMPD_CS|VERT_CS", &name);
      source = "its vertical system";
    } else if (system->IsProjected() == TRUE) {
      unit.metres = system->GetLinearUnits(&name);
      source = "its horizontal system, since it names no vertical one";
    }
    if (std::abs(unit.metres - 1.0) < 1e-12) unit.metres = 1.0;
    if (name != nullptr) unit.name = name;
  }
  if (!unit.IsMetre()) {
    warnings.push_back(file + ": heights in the unit " + unit.name + " (" + source +
                       "), converted to metres");
  }
  return unit;
}

RasterSystem SystemOf(GDALDataset& dataset,
                      const Crs& model_crs,
                      const std::string& file,
                      std::vector<std::string>& warnings) {
  const OGRSpatialReference* const found = dataset.GetSpatialRef();
  RasterSystem system;
  if (found == nullptr || found->IsEmpty() || found->IsLocal()) {
    warnings.push_back(file + ": the raster names no reference system; taken to be in " +
                       CrsName(model_crs) + ", the model's");
    system.height_unit = UnitOfHeights(dataset, nullptr, file, warnings);
    return system;
  }
  system.height_unit = UnitOfHeights(dataset, found, file, warnings);
  if (model_crs.horizontal_epsg == 0) return system;
  int vertical = 0;
  OGRSpatialReference& horizontal = system.horizontal;
  horizontal = *found;
  if (horizontal.IsCompound()) {
    const char* const code = horizontal.GetAuthorityCode("COMPD_CS|VERT_CS");
    vertical = code != nullptr ? VerticalEpsgInMetres(std::atoi(code)) : 0;
    horizontal.StripVertical();
  }
  horizontal.DemoteTo2D(nullptr);
  OGRSpatialReference expected;
  expected.importFromEPSG(model_crs.horizontal_epsg);
  constexpr const char* kCriteria[] = {"CRITERION=EQUIVALENT_EXCEPT_AXIS_ORDER_GEOGCRS",
                                       "IGNORE_DATA_AXIS_TO_SRS_AXIS_MAPPING=YES",
                                       nullptr};
  const char* const code = horizontal.GetAuthorityCode(nullptr);
  const bool same_code = code != nullptr && std::atoi(code) == model_crs.horizontal_epsg;
  const bool same = same_code || horizontal.IsSame(&expected, kCriteria) == TRUE;
  if (!same && horizontal.IsProjected() == TRUE) {
    system.metres_per_unit = horizontal.GetLinearUnits(nullptr);
    system.moves = std::abs(system.metres_per_unit - 1.0) > 1e-12;
  }
  if (!same && !system.moves) {
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
  return system;
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

// The part of any grid that a box in its own system falls on, and two cells more on each side.
Window WindowAround(const GeoTransform& g,
                    int width,
                    int height,
                    const std::vector<Eigen::Vector2d>& places) {
  GeoTransform inverse;
  if (GDALInvGeoTransform(const_cast<double*>(g.c), inverse.c) == FALSE) return {};
  Eigen::AlignedBox2d cells;
  for (const Eigen::Vector2d& p : places) {
    cells.extend(Eigen::Vector2d(inverse.c[0] + p.x() * inverse.c[1] + p.y() * inverse.c[2],
                                 inverse.c[3] + p.x() * inverse.c[4] + p.y() * inverse.c[5]));
  }
  const auto clamp = [](double value, int limit) {
    return static_cast<int>(std::clamp(value, 0.0, static_cast<double>(limit)));
  };
  constexpr double kMore = 2.0;
  const int column = clamp(std::floor(cells.min().x()) - kMore, width);
  const int row = clamp(std::floor(cells.min().y()) - kMore, height);
  return {column,
          row,
          clamp(std::ceil(cells.max().x()) + kMore, width) - column,
          clamp(std::ceil(cells.max().y()) + kMore, height) - row};
}

void CheckSize(const Window& window, const std::string& file) {
  const std::int64_t cells = std::int64_t{window.columns} * window.rows;
  if (cells <= limits::kRasterCells) return;
  throw InputError(
      file,
      "limit",
      std::to_string(window.columns) + " x " + std::to_string(window.rows) + " cells to be read",
      "at most " + std::to_string(limits::kRasterCells) +
          " (a coarser raster, or a smaller place)");
}

// The same for a window that is to be turned north up onto square cells: those of its upright box
// count, which is large where a grid is sheared or its cells are long, and each is held three
// times.
void CheckTurned(const GeoTransform& g, const Window& window, const std::string& file) {
  constexpr double kCopies = 4.0;
  Eigen::AlignedBox2d box;
  for (const double column : {0.0, static_cast<double>(window.columns)}) {
    for (const double row : {0.0, static_cast<double>(window.rows)}) {
      box.extend(Eigen::Vector2d(column * g.c[1] + row * g.c[2], column * g.c[4] + row * g.c[5]));
    }
  }
  const double cell_area = std::abs(g.c[1] * g.c[5] - g.c[2] * g.c[4]);
  const double cells =
      std::max(box.sizes().prod() / cell_area, static_cast<double>(window.columns) * window.rows);
  if (cells * kCopies <= static_cast<double>(limits::kRasterCells)) return;  // false for NaN
  throw InputError(file,
                   "limit",
                   std::to_string(window.columns) + " x " + std::to_string(window.rows) +
                       " cells to be read from a grid that is not square and north up",
                   "at most " +
                       std::to_string(limits::kRasterCells / static_cast<std::int64_t>(kCopies)) +
                       " north up (gdalwarp makes it so)");
}

// The window as a grid of heights [m] in memory, what is missing NaN.
GdalDatasetPtr CleanCopy(const GeoTransform& g,
                         const Window& window,
                         const OGRSpatialReference* system,
                         RasterValues& values,
                         const std::string& file) {
  CheckTurned(g, window, file);
  GDALDriver* const driver = GetGDALDriverManager()->GetDriverByName("MEM");
  GdalDatasetPtr copy(driver->Create("", window.columns, window.rows, 1, GDT_Float64, nullptr));
  if (copy == nullptr)
    throw InputError(file, "", "a grid that does not fit into memory", "a smaller one");
  double corner[6] = {g.c[0] + window.column * g.c[1] + window.row * g.c[2],
                      g.c[1],
                      g.c[2],
                      g.c[3] + window.column * g.c[4] + window.row * g.c[5],
                      g.c[4],
                      g.c[5]};
  copy->SetGeoTransform(corner);
  if (system != nullptr) copy->SetSpatialRef(system);
  GDALRasterBand& band = *copy->GetRasterBand(1);
  band.SetNoDataValue(std::numeric_limits<double>::quiet_NaN());
  std::vector<double> row(static_cast<std::size_t>(window.columns));
  for (int r = 0; r < window.rows; ++r) {
    values.ReadRow(window.column, window.row + r, row);
    if (band.RasterIO(GF_Write,
                      0,
                      r,
                      window.columns,
                      1,
                      row.data(),
                      window.columns,
                      1,
                      GDT_Float64,
                      0,
                      0,
                      nullptr) != CE_None) {
      throw InputError(file, "", CPLGetLastErrorMsg(), "a grid that can be copied");
    }
  }
  return copy;
}

// A clean copy on square cells, north up, in the model's system.
GdalDatasetPtr Resampled(GDALDataset& copy,
                         const GeoTransform& g,
                         const RasterSystem& system,
                         const Crs& model_crs,
                         const std::string& file) {
  const double cell_area = std::abs(g.c[1] * g.c[5] - g.c[2] * g.c[4]);
  std::vector<std::string> arguments = {"-of", "MEM", "-r", "bilinear", "-ot", "Float64"};
  for (const char* argument : {"-srcnodata", "nan", "-dstnodata", "nan", "-tr"}) {
    arguments.emplace_back(argument);
  }
  const std::string spacing = std::to_string(std::sqrt(cell_area) * system.metres_per_unit);
  arguments.insert(arguments.end(), {spacing, spacing});
  if (system.moves) {
    arguments.insert(arguments.end(),
                     {"-t_srs", "EPSG:" + std::to_string(model_crs.horizontal_epsg), "-novshift"});
  }
  std::vector<char*> pointers;
  for (std::string& argument : arguments) pointers.push_back(argument.data());
  pointers.push_back(nullptr);
  GDALWarpAppOptions* const options = GDALWarpAppOptionsNew(pointers.data(), nullptr);
  GDALDatasetH source = &copy;
  GdalDatasetPtr warped(
      GDALDataset::FromHandle(GDALWarp("", nullptr, 1, &source, options, nullptr)));
  GDALWarpAppOptionsFree(options);
  if (warped == nullptr) {
    throw InputError(
        file, "geotransform", "a grid that cannot be turned north up", "square cells, north up");
  }
  return warped;
}

HeightGrid ReadWindow(RasterValues& values,
                      const GeoTransform& g,
                      const Window& window,
                      const Eigen::Vector3d& origin,
                      const std::string& file) {
  CheckSize(window, file);
  std::vector<double> row(static_cast<std::size_t>(window.columns));
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
    values.ReadRow(window.column, last_row - r, row);
    for (const double height : row) grid.heights.push_back(static_cast<float>(height - origin.z()));
  }
  return grid;
}

// Border of the whole raster in its own system.
Eigen::AlignedBox2d ExtentOf(GDALDataset& dataset, const GeoTransform& g) {
  Eigen::AlignedBox2d extent;
  for (const int column : {0, dataset.GetRasterXSize()}) {
    for (const int row : {0, dataset.GetRasterYSize()}) {
      extent.extend(Eigen::Vector2d(g.c[0] + column * g.c[1] + row * g.c[2],
                                    g.c[3] + column * g.c[4] + row * g.c[5]));
    }
  }
  return extent;
}

// Places all over a box of the model's system, in the raster's.
std::vector<Eigen::Vector2d> PlacesOf(const Eigen::AlignedBox2d& box,
                                      const RasterSystem& system,
                                      const Crs& model_crs,
                                      const std::string& file) {
  constexpr int kSteps = 8;
  std::vector<double> x;
  std::vector<double> y;
  for (int i = 0; i <= kSteps; ++i) {
    for (int k = 0; k <= kSteps; ++k) {
      x.push_back(box.min().x() + box.sizes().x() * i / kSteps);
      y.push_back(box.min().y() + box.sizes().y() * k / kSteps);
    }
  }
  if (system.moves) {
    OGRSpatialReference from;
    from.importFromEPSG(model_crs.horizontal_epsg);
    from.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
    OGRSpatialReference to(system.horizontal);
    to.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
    const std::unique_ptr<OGRCoordinateTransformation> move(
        OGRCreateCoordinateTransformation(&from, &to));
    if (move == nullptr || move->Transform(x.size(), x.data(), y.data()) != TRUE) {
      throw InputError(file,
                       "CRS",
                       NameOf(system.horizontal) + ", which does not reach this place",
                       CrsName({model_crs.horizontal_epsg, 0}) + " (the model's)");
    }
  }
  std::vector<Eigen::Vector2d> places;
  for (std::size_t i = 0; i < x.size(); ++i) places.emplace_back(x[i], y[i]);
  return places;
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
  const GdalDatasetPtr dataset =
      OpenRaster(LocalFile(file, warnings), "a terrain model such as a GeoTIFF or a VRT");
  CheckIsTerrain(*dataset, file);
  const RasterSystem system = SystemOf(*dataset, model.crs, file, warnings);
  const auto transform = GeoTransformOf(*dataset, file);
  if (!transform) {
    throw InputError(file,
                     "geotransform",
                     "a raster that does not say where it lies",
                     "a georeferenced raster (or a world file beside it)");
  }
  GeoTransform g;
  std::copy(transform->begin(), transform->end(), g.c);
  const Eigen::Vector2d margin = Eigen::Vector2d::Constant(margin_m);
  const Eigen::Vector2d origin = model.origin_in_world.head<2>();
  const Eigen::AlignedBox2d wanted(lower + origin - margin, upper + origin + margin);
  const std::vector<Eigen::Vector2d> places = PlacesOf(wanted, system, model.crs, file);
  Eigen::AlignedBox2d wanted_here;
  for (const Eigen::Vector2d& place : places) wanted_here.extend(place);
  const Eigen::AlignedBox2d extent = ExtentOf(*dataset, g);
  const auto fail_elsewhere = [&] {
    throw InputError(file, "extent", BoxText(extent), "terrain at " + BoxText(wanted_here));
  };
  if (!extent.intersects(wanted_here)) fail_elsewhere();
  const int width = dataset->GetRasterXSize();
  const int height = dataset->GetRasterYSize();
  RasterValues values(*dataset, file, system.height_unit.metres);
  HeightGrid grid;
  if (IsSquareNorthUp(g) && !system.moves) {
    const Window window = WindowOf(g, width, height, wanted.min(), wanted.max());
    if (window.columns <= 0 || window.rows <= 0) fail_elsewhere();
    grid = ReadWindow(values, g, window, model.origin_in_world, file);
  } else {
    const Window window = WindowAround(g, width, height, places);
    if (window.columns <= 0 || window.rows <= 0) fail_elsewhere();
    const OGRSpatialReference* const reference =
        system.moves ? &system.horizontal : dataset->GetSpatialRef();
    const GdalDatasetPtr copy = CleanCopy(g, window, reference, values, file);
    const GdalDatasetPtr straight = Resampled(*copy, g, system, model.crs, file);
    straight->GetGeoTransform(g.c);
    RasterValues heights(*straight, file, 1.0);
    const Window whole{0, 0, straight->GetRasterXSize(), straight->GetRasterYSize()};
    grid = ReadWindow(heights, g, whole, model.origin_in_world, file);
  }
  for (std::string& warning : values.Warnings()) warnings.push_back(std::move(warning));
  return grid;
}

}  // namespace ridgeline
