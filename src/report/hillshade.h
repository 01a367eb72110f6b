// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <opencv2/core/mat.hpp>

#include "city/terrain.h"

namespace ridgeline {

// Shaded relief of a height grid over the box [lower, upper] (the grid's frame), lit from the
// north-west at 45 degrees, heights doubled: 8-bit grey, first row in the north, `columns` wide.
// Unknown heights are mid-grey.
cv::Mat Hillshade(const HeightGrid& grid,
                  const Eigen::Vector2d& lower,
                  const Eigen::Vector2d& upper,
                  int columns);

}  // namespace ridgeline
