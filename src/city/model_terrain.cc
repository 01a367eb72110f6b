// SPDX-License-Identifier: Apache-2.0
#include "city/model_terrain.h"

#include <gdal_alg.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>
#include <vector>

namespace ridgeline {
namespace {

// Places closer than this are one, at the lower height [m].
constexpr double kPlaceM = 0.5;
constexpr double kSpacingM = 2.0;
// The spacing grows until the grid has no more cells.
constexpr double kMaxCells = 4e6;
// How ground may rise from the lowest point of a building's walls.
constexpr double kSteepest = 0.3;
constexpr double kStepM = 0.3;

using Cell = std::pair<long, long>;

// The lowest point in each cell of kPlaceM, in the order of the cells.
using LowestPoints = std::map<Cell, Eigen::Vector3d>;

void Add(const Eigen::Vector3d& point, LowestPoints& points) {
  const Cell cell(std::lround(point.x() / kPlaceM), std::lround(point.y() / kPlaceM));
  const auto [it, added] = points.emplace(cell, point);
  if (!added && point.z() < it->second.z()) it->second = point;
}

// Feet of a building's walls among the points of its walls.
void AddFeet(const LowestPoints& walls, LowestPoints& ground) {
  if (walls.empty()) return;
  const auto lower = [](const auto& a, const auto& b) { return a.second.z() < b.second.z(); };
  const Eigen::Vector3d lowest = std::min_element(walls.begin(), walls.end(), lower)->second;
  for (const auto& [cell, point] : walls) {
    const double distance = (point - lowest).head<2>().norm();
    if (point.z() - lowest.z() <= kStepM + kSteepest * distance) Add(point, ground);
  }
}

LowestPoints GroundOf(const CityModel& model) {
  LowestPoints ground;
  std::vector<bool> has_ground(model.buildings.size(), false);
  std::vector<LowestPoints> walls(model.buildings.size());
  for (const Triangle& triangle : model.triangles) {
    const Surface& surface = model.surfaces[triangle.surface];
    const SurfaceClass kind = surface.surface_class;
    const bool is_ground = kind == SurfaceClass::kGround || kind == SurfaceClass::kTerrain;
    if (kind == SurfaceClass::kGround) has_ground[surface.building] = true;
    if (!is_ground && kind != SurfaceClass::kWall) continue;
    for (const std::uint32_t v : triangle.vertices) {
      Add(model.vertices[v], is_ground ? ground : walls[surface.building]);
    }
  }
  for (std::size_t b = 0; b < walls.size(); ++b) {
    if (!has_ground[b]) AddFeet(walls[b], ground);
  }
  return ground;
}

}  // namespace

std::optional<HeightGrid> TerrainOfModel(const CityModel& model,
                                         const Eigen::Vector2d& lower,
                                         const Eigen::Vector2d& upper) {
  std::vector<double> x;
  std::vector<double> y;
  std::vector<double> z;
  for (const auto& [cell, point] : GroundOf(model)) {
    x.push_back(point.x());
    y.push_back(point.y());
    z.push_back(point.z());
  }
  if (x.size() < 3) return std::nullopt;
  HeightGrid grid;
  const Eigen::Vector2d size = (upper - lower).cwiseMax(kSpacingM);
  grid.spacing_m = std::max(kSpacingM, std::sqrt(size.prod() / kMaxCells));
  grid.columns = static_cast<int>(std::ceil(size.x() / grid.spacing_m)) + 1;
  grid.rows = static_cast<int>(std::ceil(size.y() / grid.spacing_m)) + 1;
  grid.first = lower;
  grid.heights.resize(static_cast<std::size_t>(grid.columns) * static_cast<std::size_t>(grid.rows));
  const Eigen::Vector2d corner = lower - Eigen::Vector2d::Constant(0.5 * grid.spacing_m);
  GDALGridLinearOptions options{};
  options.nSizeOfStructure = sizeof options;
  options.dfRadius = -1.0;  // any distance to the nearest point outside of the triangulation
  options.dfNoDataValue = std::numeric_limits<double>::quiet_NaN();
  const CPLErr error = GDALGridCreate(GGA_Linear,
                                      &options,
                                      static_cast<GUInt32>(x.size()),
                                      x.data(),
                                      y.data(),
                                      z.data(),
                                      corner.x(),
                                      corner.x() + grid.columns * grid.spacing_m,
                                      corner.y(),
                                      corner.y() + grid.rows * grid.spacing_m,
                                      static_cast<GUInt32>(grid.columns),
                                      static_cast<GUInt32>(grid.rows),
                                      GDT_Float32,
                                      grid.heights.data(),
                                      nullptr,
                                      nullptr);
  if (error != CE_None) return std::nullopt;
  return grid;
}

}  // namespace ridgeline
