// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <memory>
#include <optional>
#include <vector>

#include "city/city_model.h"

namespace ridgeline {

// Terrain heights on a regular grid in a model's local frame.
struct HeightGrid {
  Eigen::Vector2d first = Eigen::Vector2d::Zero();  // east, north of value (0, 0): lower left [m]
  double spacing_m = 1.0;
  int columns = 0;
  int rows = 0;
  std::vector<float> heights;  // row-major from south to north; NaN where unknown

  // Bilinear height [m]; nullopt outside the grid or beside unknown values.
  std::optional<double> HeightAt(const Eigen::Vector2d& xy) const;
};

// Building footprints: the ground surfaces of a model, or the outlines of its walls where a
// building has none. Local frame.
class Footprints {
 public:
  explicit Footprints(const CityModel& model);
  ~Footprints();
  Footprints(Footprints&&) noexcept;
  Footprints& operator=(Footprints&&) noexcept;

  // Whether the point lies in a building.
  bool Contains(const Eigen::Vector2d& xy) const;
  // The outer rings, for maps: one polygon each, open (the first point is not repeated).
  const std::vector<std::vector<Eigen::Vector2d>>& rings() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

// Reads any GDAL raster (VRT for tiles) as a height grid in the frame of `model`. Only the part
// within `margin_m` of the box [lower, upper] (local) is read. Heights in other units (the band's,
// the vertical system's) become metres, and a raster in a system of feet is moved to the model's.
// Throws InputError for an unreadable file, a picture or anything else that is no terrain, a metric
// CRS other than the model's, or a raster that does not touch the box. A raster without a CRS is
// taken to be in the model's. What was converted, supposed or undeclared is appended to `warnings`.
HeightGrid ReadDtm(const std::filesystem::path& path,
                   const CityModel& model,
                   const Eigen::Vector2d& lower,
                   const Eigen::Vector2d& upper,
                   double margin_m,
                   std::vector<std::string>& warnings);

}  // namespace ridgeline
