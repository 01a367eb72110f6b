// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "city/city_model.h"
#include "city/city_options.h"
#include "city/source_model.h"
#include "city/tally.h"

namespace ridgeline {

// One file as it is written.
struct ModelFileInfo {
  std::string file;
  std::string format;  // e.g. "CityGML 1.0"
  std::uintmax_t bytes = 0;
  std::vector<std::string> srs_names;  // as written
  std::size_t buildings = 0;           // buildings and parts
  std::map<int, std::size_t> buildings_of_lod;
  std::map<int, std::size_t> polygons_of_lod;
  std::map<int, PolygonCount> polygons;  // of each level: in the file, read, passed over
};

// What is in model files and what ridgeline makes of it.
struct CityInfo {
  std::vector<ModelFileInfo> files;
  Crs crs;                                           // as understood
  Eigen::Vector3d lowest = Eigen::Vector3d::Zero();  // extent in `crs` [m]
  Eigen::Vector3d highest = Eigen::Vector3d::Zero();
  std::optional<Eigen::Vector2d> center_lat_lon;  // WGS 84 [deg]
  std::size_t buildings = 0;                      // wholes
  std::size_t parts = 0;
  std::array<std::size_t, 6> surfaces_of_class{};  // by SurfaceClass
  std::array<double, 6> area_of_class{};           // [m²]
  std::size_t classified_by_normal = 0;
  std::size_t vertices = 0;
  std::size_t triangles = 0;
  std::size_t edges = 0;  // folds and borders
  std::size_t seams = 0;
  double edge_length = 0.0;                  // folds and borders [m]
  std::vector<std::string> open_shells;      // ids of buildings and parts
  std::vector<std::string> crossing_shells;  // whose own surfaces cross each other
  Tally dropped;                             // what was dropped or repaired, by id
  std::vector<std::string> warnings;
};

// Reads the files as ReadCity does, but files without any building are told and not refused. Throws
// InputError for unreadable files.
CityInfo DescribeCity(const std::vector<std::filesystem::path>& paths, const CityOptions& options);

// "wall", "roof", ...
const char* SurfaceClassName(SurfaceClass surface_class);

// A raster as GDAL sees it.
struct RasterInfo {
  std::string file;
  std::string driver;  // e.g. "GTiff"
  int columns = 0;
  int rows = 0;
  int bands = 0;
  std::string crs;  // "EPSG:25832", a name, or empty
  bool georeferenced = false;
  Eigen::Vector2d spacing = Eigen::Vector2d::Zero();  // of the cells, east and north
  Eigen::Vector2d lowest = Eigen::Vector2d::Zero();   // west, south of the outer cells' borders
  Eigen::Vector2d highest = Eigen::Vector2d::Zero();
  std::string unit;                 // of the first band; empty: not said
  std::optional<double> min_value;  // of the first band, in its unit
  std::optional<double> max_value;
  double known_share = 0.0;  // of the cells [0, 1]
  int row_step = 1;          // every so manieth row was read for these
  std::vector<std::string> warnings;
  std::map<std::string, std::string> exif;  // of pictures, without the prefix "EXIF_"
  bool has_xmp = false;
};

// Throws InputError for a file that GDAL cannot open as a raster. The values are read only of
// georeferenced rasters.
RasterInfo DescribeRaster(const std::filesystem::path& path);

}  // namespace ridgeline
