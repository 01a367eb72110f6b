// SPDX-License-Identifier: Apache-2.0
#include "lines/angle_to_direction.h"

#include <algorithm>
#include <cmath>

namespace ridgeline {

double AngleToDirection(const LineSegment& segment,
                        const PinholeCamera& camera,
                        const Eigen::Vector3d& direction) {
  const Eigen::Vector2d middle = (0.5f * (segment.a + segment.b)).cast<double>();
  const Eigen::Vector3d ray = camera.RayFromImage(middle);
  const Eigen::Vector2d image(camera.fx * (direction.x() - ray.x() * direction.z()),
                              camera.fy * (direction.y() - ray.y() * direction.z()));
  const Eigen::Vector2d line = (segment.b - segment.a).cast<double>();
  const double norm = image.norm() * line.norm();
  if (norm <= 0.0) return 0.0;
  return std::asin(std::clamp((image.x() * line.y() - image.y() * line.x()) / norm, -1.0, 1.0)) *
         (image.dot(line) < 0.0 ? -1.0 : 1.0);
}

}  // namespace ridgeline
