// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

#include "city/terrain.h"

namespace ridgeline::testing {

// Samples height(east, north) on a grid.
template <typename Height>
HeightGrid MakeTerrain(
    const Eigen::Vector2d& first, double spacing_m, int columns, int rows, const Height& height) {
  HeightGrid grid;
  grid.first = first;
  grid.spacing_m = spacing_m;
  grid.columns = columns;
  grid.rows = rows;
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column) {
      grid.heights.push_back(
          static_cast<float>(height(first.x() + column * spacing_m, first.y() + row * spacing_m)));
    }
  }
  return grid;
}

}  // namespace ridgeline::testing
