// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <cstdint>
#include <vector>

#include "projection/scene.h"
#include "projection/simd4.h"

namespace ridgeline {

// The surface seen in every direction of a sector from one position, on a grid of azimuth
// (clockwise from north) and elevation. Orientation-free, like VisibleSet.
struct SurfacePanorama {
  double first_azimuth = 0.0;    // of column 0 [rad]
  double first_elevation = 0.0;  // of row 0 [rad]
  double step = 0.0;             // between columns and between rows [rad]
  int columns = 0;
  int rows = 0;
  std::vector<std::uint32_t> surfaces;  // row-major; kNoSurface: sky

  // Surface in a direction (east, north, height), by the nearest ray; nullptr outside the grid.
  const std::uint32_t* Find(const Eigen::Vector3f& direction) const;
  // Indices into `surfaces` for four directions; -1 outside the grid.
  simd::Int4 Find(const simd::Vec3x4& directions) const { return CellsAt(PlacesOf(directions)); }

  // Places in the grid: cell i spans [i, i + 1). The column jumps by a turn behind the first one.
  struct Places {
    simd::Float4 column, row;
  };
  Places PlacesOf(const simd::Vec3x4& directions) const;
  simd::Int4 CellsAt(const Places& places) const {
    const simd::Int4 column = __builtin_convertvector(places.column, simd::Int4);
    const simd::Int4 row = __builtin_convertvector(places.row, simd::Int4);
    const simd::Int4 inside = (places.column >= 0.0f) & (column < columns) &
                              (places.row >= 0.0f) & (row < rows);
    return inside ? row * columns + column : simd::Int4{-1, -1, -1, -1};
  }
};

struct PanoramaRange {
  Sector sector;
  double step = 0.02;  // [rad]
};

// Rays are cast four steps apart, and between those that see different surfaces down to every step;
// what is thinner than four steps can be missed.
SurfacePanorama SurfacesFrom(const Scene& scene,
                             const Eigen::Vector3d& position,
                             const PanoramaRange& range);

}  // namespace ridgeline
