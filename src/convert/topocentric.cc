// SPDX-License-Identifier: Apache-2.0
#include "convert/topocentric.h"

#include <cmath>
#include <numbers>

#include "base/error.h"
#include "city/crs.h"

namespace ridgeline {
namespace {

constexpr double kRadPerDeg = std::numbers::pi / 180.0;
constexpr double kSemiMajor = 6378137.0;  // WGS 84
constexpr double kFlattening = 1.0 / 298.257223563;
constexpr double kEccentricity2 = kFlattening * (2.0 - kFlattening);

double PrimeVertical(double latitude_rad) {
  const double s = std::sin(latitude_rad);
  return kSemiMajor / std::sqrt(1.0 - kEccentricity2 * s * s);
}

Eigen::Vector3d EarthFromGeodetic(double latitude_rad, double longitude_rad, double height) {
  const double n = PrimeVertical(latitude_rad);
  const double from_axis = (n + height) * std::cos(latitude_rad);
  return {from_axis * std::cos(longitude_rad),
          from_axis * std::sin(longitude_rad),
          (n * (1.0 - kEccentricity2) + height) * std::sin(latitude_rad)};
}

// Columns: east, north, up in earth-centred axes.
Eigen::Matrix3d AxesAt(double latitude_rad, double longitude_rad) {
  const double sa = std::sin(latitude_rad);
  const double ca = std::cos(latitude_rad);
  const double so = std::sin(longitude_rad);
  const double co = std::cos(longitude_rad);
  Eigen::Matrix3d axes;
  axes << -so, -sa * co, ca * co, co, -sa * so, ca * so, 0.0, ca, sa;
  return axes;
}

}  // namespace

Topocentric::Topocentric(double latitude_deg, double longitude_deg, double height_m)
    : origin_in_earth_(
          EarthFromGeodetic(latitude_deg * kRadPerDeg, longitude_deg * kRadPerDeg, height_m)),
      earth_from_local_(AxesAt(latitude_deg * kRadPerDeg, longitude_deg * kRadPerDeg)) {}

Eigen::Vector3d Topocentric::Geodetic(const Eigen::Vector3d& east_north_up) const {
  const Eigen::Vector3d point = origin_in_earth_ + earth_from_local_ * east_north_up;
  const double from_axis = std::hypot(point.x(), point.y());
  // Fixed point of the latitude; each round gains more than two digits near the ground.
  double latitude = std::atan2(point.z(), from_axis * (1.0 - kEccentricity2));
  for (int round = 0; round < 10; ++round) {
    latitude = std::atan2(point.z() + kEccentricity2 * PrimeVertical(latitude) * std::sin(latitude),
                          from_axis);
  }
  const double s = std::sin(latitude);
  const double height = from_axis * std::cos(latitude) + point.z() * s -
                        kSemiMajor * std::sqrt(1.0 - kEccentricity2 * s * s);
  return {latitude / kRadPerDeg, std::atan2(point.y(), point.x()) / kRadPerDeg, height};
}

Pose Topocentric::ToProjected(const Pose& pose, const Crs& crs, const std::string& file) const {
  const Eigen::Vector3d place = Geodetic(pose.center_in_world);
  const auto east_north = EastNorth(crs, place.x(), place.y());
  const auto convergence = east_north ? MeridianConvergenceDeg(crs, *east_north) : std::nullopt;
  if (!convergence) {
    throw InputError(
        file,
        "position",
        "latitude " + std::to_string(place.x()) + ", longitude " + std::to_string(place.y()),
        "a place in the reach of " + CrsName(crs));
  }
  CheckMapSystem(crs, *east_north, file, "crs");
  // Grid east and north in true east and north.
  const double c = std::cos(*convergence * kRadPerDeg);
  const double s = std::sin(*convergence * kRadPerDeg);
  Eigen::Matrix3d true_from_grid;
  true_from_grid << c, s, 0.0, -s, c, 0.0, 0.0, 0.0, 1.0;
  const Eigen::Matrix3d local_from_grid = earth_from_local_.transpose() *
                                          AxesAt(place.x() * kRadPerDeg, place.y() * kRadPerDeg) *
                                          true_from_grid;
  Pose projected;
  projected.center_in_world = {east_north->x(), east_north->y(), place.z()};
  projected.cam_from_world =
      (pose.cam_from_world * Eigen::Quaterniond(local_from_grid)).normalized();
  return projected;
}

}  // namespace ridgeline
