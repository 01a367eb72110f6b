// SPDX-License-Identifier: Apache-2.0
#include "report/hillshade.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace ridgeline {

cv::Mat Hillshade(const HeightGrid& grid,
                  const Eigen::Vector2d& lower,
                  const Eigen::Vector2d& upper,
                  int columns) {
  constexpr double kExaggeration = 2.0;
  const Eigen::Vector3d light = Eigen::Vector3d(-1.0, 1.0, std::sqrt(2.0)).normalized();
  const Eigen::Vector2d size = upper - lower;
  const int rows = std::max(1, static_cast<int>(std::lround(columns * size.y() / size.x())));
  const double step = grid.spacing_m;
  cv::Mat shade(rows, columns, CV_8U, cv::Scalar(128));
  for (int r = 0; r < rows; ++r) {
    for (int c = 0; c < columns; ++c) {
      const Eigen::Vector2d at = lower + Eigen::Vector2d((c + 0.5) / columns * size.x(),
                                                         (rows - 0.5 - r) / rows * size.y());
      const auto west = grid.HeightAt(at - Eigen::Vector2d(step, 0.0));
      const auto east = grid.HeightAt(at + Eigen::Vector2d(step, 0.0));
      const auto south = grid.HeightAt(at - Eigen::Vector2d(0.0, step));
      const auto north = grid.HeightAt(at + Eigen::Vector2d(0.0, step));
      if (!west || !east || !south || !north) continue;
      const Eigen::Vector3d normal(-kExaggeration * (*east - *west) / (2.0 * step),
                                   -kExaggeration * (*north - *south) / (2.0 * step),
                                   1.0);
      shade.at<uchar>(r, c) =
          cv::saturate_cast<uchar>(255.0 * std::max(0.0, normal.normalized().dot(light)));
    }
  }
  return shade;
}

}  // namespace ridgeline
