// SPDX-License-Identifier: Apache-2.0
#include "track/sensors.h"

#include <algorithm>
#include <cmath>

#include "base/angle.h"
#include "city/crs.h"

namespace ridgeline {

DeviceTilt TiltFromUpward(const Eigen::Vector3d& u) {
  return {std::atan2(u.z(), std::hypot(u.x(), u.y())) * kDegPerRad,
          std::atan2(-u.x(), -u.y()) * kDegPerRad};
}

Eigen::Vector3d UpwardInCamera(const Eigen::Vector3d& a, const std::string& held) {
  if (held == "landscape") return {-a.y(), -a.x(), -a.z()};
  return {a.x(), -a.y(), -a.z()};
}

double HeightBetween(double from_hpa, double to_hpa) {
  constexpr double kTemperature = 288.15, kLapse = 0.0065, kExponent = 0.190263;
  return kTemperature / kLapse * (1.0 - std::pow(to_hpa / from_hpa, kExponent));
}

SensorPriors::SensorPriors(const Crs& crs, const SensorOptions& options)
    : crs_(crs), options_(options) {
  CheckOptions(options_, "sensors");
}

Eigen::Vector2d SensorPriors::Project(double latitude_deg, double longitude_deg) const {
  const Eigen::Vector3d place(latitude_deg, longitude_deg, 0.0);
  const ToProjected to_model({4326, 0}, {crs_.horizontal_epsg, 0}, place, "sensors");
  std::vector<Eigen::Vector3d> points{place};
  to_model.Apply(points);
  return points.front().head<2>();
}

double SensorPriors::GridHeading(const SensorReading& reading) const {
  double heading = *reading.compass_deg;
  if (options_.heading_reference == "grid") return heading;
  if (options_.heading_reference == "magnetic") heading += options_.declination_deg;
  // Meridian convergence: where true north points to in the grid.
  constexpr double kStepDeg = 0.001;
  const Eigen::Vector2d here = Project(*reading.latitude_deg, *reading.longitude_deg);
  const Eigen::Vector2d north =
      Project(*reading.latitude_deg + kStepDeg, *reading.longitude_deg) - here;
  return heading + std::atan2(north.x(), north.y()) * kDegPerRad;
}

std::optional<double> SensorPriors::HeightOf(const SensorReading& reading,
                                             std::optional<double> terrain_m,
                                             std::string& missing) {
  if (options_.height_source == "gnss") {
    if (!reading.altitude_m) missing = "altitude";
    return reading.altitude_m;
  }
  if (options_.height_source == "barometer" && reference_hpa_) {
    if (reading.pressure_hpa) {
      return reference_height_m_ + HeightBetween(*reference_hpa_, *reading.pressure_hpa);
    }
    missing = "pressure";
    return std::nullopt;
  }
  if (!terrain_m) {
    missing = "terrain height";
    return std::nullopt;
  }
  const double height = *terrain_m + options_.camera_height_m;
  if (options_.height_source == "barometer") {
    if (!reading.pressure_hpa) {
      missing = "pressure";
      return std::nullopt;
    }
    reference_hpa_ = reading.pressure_hpa;
    reference_height_m_ = height;
  }
  return height;
}

std::optional<PosePrior> SensorPriors::PriorOf(
    const SensorReading& reading,
    const std::function<std::optional<double>(const Eigen::Vector2d&)>& terrain_m,
    std::string& missing) {
  if (!reading.latitude_deg || !reading.longitude_deg) missing = "position";
  if (!reading.compass_deg) missing = "compass heading";
  if (!reading.latitude_deg || !reading.longitude_deg || !reading.compass_deg) return std::nullopt;
  PosePrior prior;
  prior.position_in_world = Project(*reading.latitude_deg, *reading.longitude_deg);
  prior.height_in_world = HeightOf(reading, terrain_m(prior.position_in_world), missing);
  if (!prior.height_in_world) return std::nullopt;
  prior.heading_deg = WrapHeadingDeg(GridHeading(reading));
  prior.pitch_deg = reading.pitch_deg;
  prior.roll_deg = reading.roll_deg;
  if (prior.roll_deg && options_.roll_sense == "counterclockwise") *prior.roll_deg *= -1.0;
  if (reading.acceleration) {
    const DeviceTilt tilt = TiltFromUpward(UpwardInCamera(*reading.acceleration, options_.held));
    if (!prior.pitch_deg) prior.pitch_deg = tilt.pitch_deg;
    if (!prior.roll_deg) prior.roll_deg = tilt.roll_deg;
  }
  return prior;
}

}  // namespace ridgeline
