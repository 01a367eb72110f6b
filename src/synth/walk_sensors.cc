// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "base/angle.h"
#include "base/error.h"
#include "base/random.h"
#include "city/crs.h"
#include "synth/walk.h"

namespace ridgeline {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr std::uint64_t kSensorStage = 0x91;
constexpr double kGravity = 9.81;
// Share of frames at which the altitude jumps, and how many frames a jump lasts.
constexpr double kJumpShare = 0.1;
constexpr int kJumpFrames = 4;
constexpr double kSeaLevelHpa = 1013.25;

// An error that drifts: an autoregressive process of unit variance with the given time constant.
class Drift {
 public:
  Drift(double time_constant_s, double frame_s, Random& random)
      : keep_(std::exp(-frame_s / time_constant_s)), random_(random), value_(random.Normal()) {}
  double Next() {
    const double value = value_;
    value_ = keep_ * value_ + std::sqrt(1.0 - keep_ * keep_) * random_.Normal();
    return value;
  }

 private:
  double keep_;
  Random& random_;
  double value_;
};

// Air pressure of the standard atmosphere.
double PressureAt(double height_m) {
  return kSeaLevelHpa * std::pow(1.0 - 0.0065 * height_m / 288.15, 1.0 / 0.190263);
}

// Acceleration of a phone held in landscape (its top to the left) at rest.
Vector3d AccelerationOf(const Pose& pose) {
  const Vector3d up = pose.cam_from_world * Vector3d::UnitZ();
  return kGravity * Vector3d(-up.y(), -up.x(), -up.z());
}

// Grid azimuth of true north.
double ConvergenceDeg(const Crs& crs, const Vector2d& east_north) {
  constexpr double kStepM = 100.0;
  const auto here = LatitudeLongitude(crs, east_north);
  const auto north = LatitudeLongitude(crs, east_north + Vector2d(0.0, kStepM));
  if (!here || !north) return 0.0;
  const double north_deg = north->x() - here->x();
  const double east_deg = (north->y() - here->y()) * std::cos(here->x() / kDegPerRad);
  // Grid north as seen from true north, turned around.
  return -std::atan2(east_deg, north_deg) * kDegPerRad;
}

}  // namespace

std::string WalkSensorsCsv(const Town& town,
                           const std::vector<Pose>& cam_from_local,
                           const WalkOptions& options) {
  const Crs crs{town.epsg, 0};
  const double frame_s = 1.0 / options.frames_per_second;
  Random random(static_cast<std::uint64_t>(town.options.seed), kSensorStage);
  Drift compass(20.0, frame_s, random), length(30.0, frame_s, random),
      direction(60.0, frame_s, random), pitch(8.0, frame_s, random), roll(8.0, frame_s, random);
  const double direction0 = random.Uniform(0.0, 2.0 * std::numbers::pi);
  std::string csv =
      "# a phone on a walk: WGS 84, magnetic compass (declination " +
      std::to_string(options.declination_deg) +
      " deg), pitch and roll by gyroscope, acceleration of the phone in landscape\n"
      "id,time_s,lat_deg,lon_deg,alt_m,compass_heading_deg,pitch_deg,roll_deg,acc_x,acc_y,acc_z,"
      "pressure_hpa\n";
  double jump_m = 0.0;
  int jump_left = 0;
  for (std::size_t i = 0; i < cam_from_local.size(); ++i) {
    const Pose& pose = cam_from_local[i];
    const Vector3d world = pose.center_in_world + town.origin_in_world;
    const ViewAngles angles = ViewAnglesOf(pose.cam_from_world);

    const double share = 0.5 + 0.5 * std::tanh(length.Next());
    const double error_m =
        options.gnss_error_low_m + share * (options.gnss_error_high_m - options.gnss_error_low_m);
    const double towards = direction0 + direction.Next();
    const auto place = LatitudeLongitude(
        crs, world.head<2>() + error_m * Vector2d(std::sin(towards), std::cos(towards)));
    if (!place) throw InputError("", "walk.town", CrsName(crs), "a system that PROJ knows");

    if (jump_left == 0 && random.Uniform() < kJumpShare / kJumpFrames) {
      jump_left = kJumpFrames;
      jump_m = random.Uniform(-options.altitude_jump_m, options.altitude_jump_m);
    }
    const double altitude =
        world.z() + options.altitude_noise_m * random.Normal() + (jump_left > 0 ? jump_m : 0.0);
    jump_left = std::max(0, jump_left - 1);

    const double compass_deg = angles.heading_deg - ConvergenceDeg(crs, world.head<2>()) -
                               options.declination_deg +
                               options.compass_error_deg * std::tanh(compass.Next()) +
                               options.compass_noise_deg * random.Normal();
    Vector3d acceleration = AccelerationOf(pose);
    for (int axis = 0; axis < 3; ++axis) {
      acceleration[axis] += options.acceleration_noise * random.Normal();
    }
    char row[320];
    std::snprintf(row,
                  sizeof row,
                  "frame_%04zu,%.3f,%.8f,%.8f,%.2f,%.2f,%.2f,%.2f,%.3f,%.3f,%.3f,%.3f\n",
                  i,
                  static_cast<double>(i) * frame_s,
                  place->x(),
                  place->y(),
                  altitude,
                  WrapHeadingDeg(compass_deg),
                  angles.pitch_deg + options.tilt_sigma_deg * pitch.Next(),
                  angles.roll_deg + options.tilt_sigma_deg * roll.Next(),
                  acceleration.x(),
                  acceleration.y(),
                  acceleration.z(),
                  PressureAt(world.z()) + options.pressure_noise_hpa * random.Normal());
    csv += row;
  }
  return csv;
}

}  // namespace ridgeline
