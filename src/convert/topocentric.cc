// SPDX-License-Identifier: Apache-2.0
#include "convert/topocentric.h"

#include <proj.h>

#include <cmath>
#include <locale>
#include <sstream>
#include <string>

#include "base/angle.h"
#include "base/error.h"
#include "city/crs.h"

namespace ridgeline {
namespace {

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

struct Topocentric::Impl {
  PJ_CONTEXT* context = proj_context_create();
  PJ* geodetic_from_local = nullptr;
  Eigen::Matrix3d earth_from_local;

  ~Impl() {
    proj_destroy(geodetic_from_local);
    proj_context_destroy(context);
  }
};

namespace {

[[noreturn]] void FailPlace(double latitude_deg, double longitude_deg) {
  throw InputError("reference_lla",
                   "",
                   std::to_string(latitude_deg) + ", " + std::to_string(longitude_deg),
                   "latitude and longitude of the topocentric frame [deg]");
}

}  // namespace

Topocentric::Topocentric(double latitude_deg, double longitude_deg, double height_m)
    : impl_(std::make_unique<Impl>()) {
  // PROJ would say the same, on the terminal.
  if (!(std::abs(latitude_deg) <= 90.0 && std::abs(longitude_deg) <= 360.0)) {
    FailPlace(latitude_deg, longitude_deg);
  }
  impl_->earth_from_local = AxesAt(latitude_deg * kRadPerDeg, longitude_deg * kRadPerDeg);
  std::ostringstream pipeline;
  pipeline.imbue(std::locale::classic());
  pipeline.precision(17);
  pipeline << "+proj=pipeline +ellps=WGS84 +step +inv +proj=topocentric +lat_0=" << latitude_deg
           << " +lon_0=" << longitude_deg << " +h_0=" << height_m
           << " +step +inv +proj=cart +step +proj=unitconvert +xy_in=rad +xy_out=deg";
  impl_->geodetic_from_local = proj_create(impl_->context, pipeline.str().c_str());
  if (impl_->geodetic_from_local == nullptr) FailPlace(latitude_deg, longitude_deg);
}

Topocentric::~Topocentric() = default;

Eigen::Vector3d Topocentric::Geodetic(const Eigen::Vector3d& east_north_up) const {
  const PJ_COORD place =
      proj_trans(impl_->geodetic_from_local,
                 PJ_FWD,
                 proj_coord(east_north_up.x(), east_north_up.y(), east_north_up.z(), 0.0));
  return {place.xyz.y, place.xyz.x, place.xyz.z};
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
  const Eigen::Matrix3d local_from_grid = impl_->earth_from_local.transpose() *
                                          AxesAt(place.x() * kRadPerDeg, place.y() * kRadPerDeg) *
                                          true_from_grid;
  Pose projected;
  projected.center_in_world = {east_north->x(), east_north->y(), place.z()};
  projected.cam_from_world =
      (pose.cam_from_world * Eigen::Quaterniond(local_from_grid)).normalized();
  return projected;
}

}  // namespace ridgeline
