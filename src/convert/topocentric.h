// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <memory>
#include <string>

#include "camera/pose.h"
#include "city/city_model.h"

namespace ridgeline {

// East, north, up [m] at a place on the WGS 84 ellipsoid, and its way to a projected system, by
// PROJ. For one thread at a time.
class Topocentric {
 public:
  // Heights of the place and of what comes out are of one kind; above the ellipsoid to be exact.
  // Throws InputError where there is no such place.
  Topocentric(double latitude_deg, double longitude_deg, double height_m);
  ~Topocentric();

  // Latitude, longitude [deg] and height [m] of a point.
  Eigen::Vector3d Geodetic(const Eigen::Vector3d& east_north_up) const;

  // The pose in a projected system: position by PROJ, rotation from the frame's axes to the grid's
  // at the camera. Throws InputError, naming `file`, where PROJ has no answer.
  Pose ToProjected(const Pose& pose, const Crs& crs, const std::string& file) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace ridgeline
