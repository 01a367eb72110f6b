// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <span>
#include <vector>

#include "camera/intrinsics.h"
#include "camera/pose.h"

namespace ridgeline {

// A virtual skyline drawn in the image plane, for 2D matching (Ayadi et al., 6.3.2). Reaches beyond
// the picture on both sides, so that it can be shifted.
class SkylineDrawing {
 public:
  // Shift [px of the camera] and clockwise turn about the principal point [rad].
  struct Motion {
    double x_px = 0.0;
    double y_px = 0.0;
    double turn_rad = 0.0;
  };

  // @param directions  Unit vectors by azimuth, as of SkylineDirections().
  // @param precision_px  Of its simplification (Douglas-Peucker).
  SkylineDrawing(std::span<const Eigen::Vector3f> directions,
                 const PinholeCamera& camera,
                 const Eigen::Quaterniond& cam_from_world,
                 double precision_px);

  // Rows at which the moved skyline crosses the columns of the picture; NaN where it does not.
  void Rows(const Motion& motion, std::span<float> rows) const;

  std::size_t size() const { return points_.size(); }

 private:
  std::vector<Eigen::Vector2f> points_;  // from the principal point [px]
  Eigen::Vector2f principal_point_;
};

// The rotation of the camera in which the picture is the old one moved by `motion`: exact at the
// principal point, and everywhere for a turn alone.
Eigen::Quaterniond RotationAfter(const SkylineDrawing::Motion& motion,
                                 const PinholeCamera& camera,
                                 const Eigen::Quaterniond& cam_from_world);

// The paper's approximation: angles proportional to shifts, by the field of view per pixel.
Eigen::Quaterniond RotationAfterLinear(const SkylineDrawing::Motion& motion,
                                       const PinholeCamera& camera,
                                       const Eigen::Quaterniond& cam_from_world);

}  // namespace ridgeline
