// SPDX-License-Identifier: Apache-2.0
#include <Eigen/Geometry>
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
constexpr std::uint64_t kGyroStage = 0x93;
constexpr std::uint64_t kGnssStage = 0x95;
constexpr std::uint64_t kOdometryStage = 0x94;
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

// Rotation rates [rad/s] of a phone held in landscape, at frame i, by the frames beside it. No
// instrument is as slow as the film: what the hand does between the frames is not in them.
Vector3d RatesOf(const std::vector<Pose>& poses, std::size_t i, double frame_s) {
  if (poses.size() < 2) return Vector3d::Zero();
  const std::size_t a = i == 0 ? 0 : i - 1;
  const std::size_t b = std::min(i + 1, poses.size() - 1);
  const Eigen::AngleAxisd turn(poses[b].cam_from_world * poses[a].cam_from_world.conjugate());
  // The axes turn against what they see.
  const Vector3d in_camera = -turn.angle() * turn.axis() / (static_cast<double>(b - a) * frame_s);
  return {-in_camera.y(), -in_camera.x(), -in_camera.z()};
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

// What befalls the receiver at a time.
class Trouble {
 public:
  Trouble(const WalkOptions& options)
      : trouble_(options.gnss),
        random_(static_cast<std::uint64_t>(options.town.seed), kGnssStage) {
    const double towards = random_.Uniform(0.0, 2.0 * std::numbers::pi);
    direction_ = {std::sin(towards), std::cos(towards)};
  }

  bool IsOut(double time_s) const {
    return trouble_.outage_from_s >= 0.0 && time_s >= trouble_.outage_from_s &&
           time_s < trouble_.outage_to_s;
  }
  // Error [m] that is added at the next fix.
  Vector2d Next(double time_s) {
    Vector2d error = trouble_.noise_m * Vector2d(random_.Normal(), random_.Normal());
    if (trouble_.jump_at_s >= 0.0 && time_s >= trouble_.jump_at_s) {
      error += trouble_.jump_m * direction_;
    }
    if (trouble_.spoof_from_s >= 0.0 && time_s >= trouble_.spoof_from_s) {
      error += trouble_.spoof_m_s * (time_s - trouble_.spoof_from_s) * direction_;
    }
    return error;
  }
  // Of the wheels, with a noise of 2 %.
  double Speed(double true_m_s) { return true_m_s * (1.0 + 0.02 * random_.Normal()); }

 private:
  GnssTrouble trouble_;
  Random random_;
  Vector2d direction_;
};

double SpeedAt(const std::vector<Pose>& poses, std::size_t i, double frame_s) {
  if (poses.size() < 2) return 0.0;
  const std::size_t a = i == 0 ? 0 : i - 1;
  return (poses[a + 1].center_in_world - poses[a].center_in_world).norm() / frame_s;
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
      "pressure_hpa,speed_m_s,gyro_x,gyro_y,gyro_z\n";
  Random gyro(static_cast<std::uint64_t>(town.options.seed), kGyroStage);
  Vector3d gyro_bias;
  for (int axis = 0; axis < 3; ++axis) gyro_bias[axis] = options.gyro_bias * gyro.Normal();
  Trouble trouble(options);
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
        crs, world.head<2>() + error_m * Vector2d(std::sin(towards), std::cos(towards)) +
                 trouble.Next(static_cast<double>(i) * frame_s));
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
    // A bias that stays and a noise, after everything else, so that older numbers are as they were.
    Vector3d rates = RatesOf(cam_from_local, i, frame_s) + gyro_bias;
    for (int axis = 0; axis < 3; ++axis) rates[axis] += options.gyro_noise * gyro.Normal();
    char fix[64] = ",,";
    if (!trouble.IsOut(static_cast<double>(i) * frame_s)) {
      std::snprintf(fix, sizeof fix, "%.8f,%.8f,%.2f", place->x(), place->y(), altitude);
    }
    char row[420];
    std::snprintf(row,
                  sizeof row,
                  "frame_%04zu,%.3f,%s,%.2f,%.2f,%.2f,%.3f,%.3f,%.3f,%.3f,%.3f,%.5f,%.5f,%.5f\n",
                  i,
                  static_cast<double>(i) * frame_s,
                  fix,
                  WrapHeadingDeg(compass_deg),
                  angles.pitch_deg + options.tilt_sigma_deg * pitch.Next(),
                  angles.roll_deg + options.tilt_sigma_deg * roll.Next(),
                  acceleration.x(),
                  acceleration.y(),
                  acceleration.z(),
                  PressureAt(world.z()) + options.pressure_noise_hpa * random.Normal(),
                  trouble.Speed(SpeedAt(cam_from_local, i, frame_s)),
                  rates.x(),
                  rates.y(),
                  rates.z());
    csv += row;
  }
  return csv;
}

std::string WalkOdometryCsv(const std::vector<Pose>& cam_from_local, const WalkOptions& options) {
  const OdometryErrors& errors = options.odometry;
  const double frame_s = 1.0 / options.frames_per_second;
  Random random(static_cast<std::uint64_t>(options.town.seed), kOdometryStage);
  std::string csv =
      "# pose of each frame in the camera axes of the frame before: x right, y down, z forward\n"
      "id,time_s,dx_m,dy_m,dz_m,qw,qx,qy,qz,sigma_m,sigma_deg\n";
  for (std::size_t i = 1; i < cam_from_local.size(); ++i) {
    const Pose& before = cam_from_local[i - 1];
    const Pose& now = cam_from_local[i];
    const Vector3d step = before.CameraFromWorld(now.center_in_world);
    const double noise_m = errors.noise_share * step.norm();
    const Vector3d noise(random.Normal(), random.Normal(), random.Normal());
    const Vector3d measured = errors.scale * (step + noise_m * noise);
    // Small turns about the axes right, down and forward.
    const double heading_deg =
        errors.heading_noise_deg * random.Normal() + errors.drift_deg_s * frame_s;
    const double tilt_deg = errors.heading_noise_deg / 3.0;
    const Vector3d turn(tilt_deg * random.Normal(), heading_deg, tilt_deg * random.Normal());
    const Eigen::Quaterniond error(
        Eigen::AngleAxisd(turn.norm() / kDegPerRad,
                          turn.norm() > 0.0 ? Vector3d(turn.normalized()) : Vector3d::UnitY()));
    const Eigen::Quaterniond before_from_now =
        before.cam_from_world * now.cam_from_world.conjugate() * error;
    const double sigma_deg =
        std::hypot(errors.heading_noise_deg, errors.drift_deg_s * frame_s);
    char row[320];
    std::snprintf(row,
                  sizeof row,
                  "frame_%04zu,%.3f,%.5f,%.5f,%.5f,%.9f,%.9f,%.9f,%.9f,%.4f,%.4f\n",
                  i,
                  static_cast<double>(i) * frame_s,
                  measured.x(),
                  measured.y(),
                  measured.z(),
                  before_from_now.w(),
                  before_from_now.x(),
                  before_from_now.y(),
                  before_from_now.z(),
                  std::max(0.01, errors.scale * noise_m),
                  std::max(0.02, sigma_deg));
    csv += row;
  }
  return csv;
}

}  // namespace ridgeline
