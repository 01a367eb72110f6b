// SPDX-License-Identifier: Apache-2.0
#include "track/gyroscope.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "base/error.h"

namespace ridgeline {
namespace {

// Rates farther apart say nothing of what was between them [s].
constexpr double kLongestGapS = 2.0;

struct Tilt {
  std::optional<double> pitch_deg, roll_deg;
};

// Pitch and clockwise roll of the instruments.
Tilt TiltOf(const SensorReading& reading, const SensorOptions& options) {
  Tilt tilt{reading.pitch_deg, reading.roll_deg};
  if (tilt.roll_deg && options.roll_sense == "counterclockwise") *tilt.roll_deg *= -1.0;
  if (!reading.acceleration) return tilt;
  const DeviceTilt by_gravity =
      TiltFromUpward(UpwardInCamera(*reading.acceleration, options.held));
  if (!tilt.pitch_deg) tilt.pitch_deg = by_gravity.pitch_deg;
  if (!tilt.roll_deg) tilt.roll_deg = by_gravity.roll_deg;
  return tilt;
}

// Camera axes turned by a rotation of the camera (in its own axes).
Eigen::Quaterniond Turned(const Eigen::Quaterniond& cam_from_world,
                          const Eigen::Vector3d& rotation_rad) {
  const double angle = rotation_rad.norm();
  if (angle == 0.0) return cam_from_world;
  return Eigen::Quaterniond(Eigen::AngleAxisd(-angle, rotation_rad / angle)) * cam_from_world;
}

// Moves the angles towards the instruments by a share.
Eigen::Quaterniond PulledBack(const Eigen::Quaterniond& cam_from_world,
                              const SensorReading& reading,
                              const Tilt& tilt,
                              double share) {
  ViewAngles angles = ViewAnglesOf(cam_from_world);
  if (reading.compass_deg) {
    angles.heading_deg += share * HeadingDifferenceDeg(*reading.compass_deg, angles.heading_deg);
  }
  if (tilt.pitch_deg) angles.pitch_deg += share * (*tilt.pitch_deg - angles.pitch_deg);
  if (tilt.roll_deg) {
    angles.roll_deg += share * HeadingDifferenceDeg(*tilt.roll_deg, angles.roll_deg);
  }
  return CamFromWorld(angles);
}

void Put(const Eigen::Quaterniond& cam_from_world,
         const SensorOptions& options,
         SensorReading& reading) {
  const ViewAngles angles = ViewAnglesOf(cam_from_world);
  reading.compass_deg = angles.heading_deg;
  reading.pitch_deg = angles.pitch_deg;
  reading.roll_deg = options.roll_sense == "counterclockwise" ? -angles.roll_deg : angles.roll_deg;
}

}  // namespace

std::vector<SensorReading> IntegrateGyroscope(std::vector<SensorReading> readings,
                                              const SensorOptions& options,
                                              const std::string& file) {
  const bool any = std::any_of(readings.begin(), readings.end(), [](const SensorReading& r) {
    return r.rotation_rad_s && r.time_s;
  });
  if (!any) {
    throw InputError(file,
                     "gyro_x",
                     "no row with rotation rates and a time",
                     "columns gyro_x, gyro_y, gyro_z [rad/s] and time_s, or sensors.attitude=tilt");
  }
  std::optional<Eigen::Quaterniond> attitude;
  std::optional<Eigen::Vector3d> last_rate;
  double last_time_s = 0.0;
  for (SensorReading& reading : readings) {
    const Tilt tilt = TiltOf(reading, options);
    if (!reading.time_s || !reading.rotation_rad_s) {
      attitude.reset();
      continue;
    }
    // Rotation vectors turn with the axes, as accelerations do.
    const Eigen::Vector3d rate = UpwardInCamera(*reading.rotation_rad_s, options.held);
    const double step_s = *reading.time_s - last_time_s;
    if (attitude && last_rate && step_s > 0.0 && step_s <= kLongestGapS) {
      *attitude = Turned(*attitude, 0.5 * (rate + *last_rate) * step_s);
      *attitude =
          PulledBack(*attitude, reading, tilt, step_s / (options.gyro_time_constant_s + step_s));
    } else if (reading.compass_deg && tilt.pitch_deg && tilt.roll_deg) {
      attitude = CamFromWorld(ViewAngles{*reading.compass_deg, *tilt.pitch_deg, *tilt.roll_deg});
    } else {
      attitude.reset();
    }
    if (attitude) Put(*attitude, options, reading);
    last_rate = rate;
    last_time_s = *reading.time_s;
  }
  return readings;
}

}  // namespace ridgeline
