// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "base/options.h"
#include "camera/pose.h"
#include "camera/pose_prior.h"
#include "city/city_model.h"

namespace ridgeline {

// What a phone's or vehicle's instruments say at one frame. Parts that are missing are absent.
struct SensorReading {
  std::string id;  // of the frame
  std::optional<double> time_s;
  std::optional<double> latitude_deg;  // WGS 84
  std::optional<double> longitude_deg;
  std::optional<double> altitude_m;   // above sea level, in the model's height system
  std::optional<double> compass_deg;  // heading of the optical axis; see heading_reference
  std::optional<double> pitch_deg;    // as in ViewAngles
  std::optional<double> roll_deg;     // see roll_sense
  std::optional<Eigen::Vector3d> acceleration;  // device axes; at rest upward, any unit
  std::optional<double> pressure_hpa;
  std::optional<Eigen::Vector3d> rotation_rad_s;  // device axes, right-handed
  std::optional<double> speed_m_s;  // of the wheels; backward: negative
};

struct SensorOptions {
  // What the compass counts from: "grid", "true" or "magnetic" north.
  std::string heading_reference = "magnetic";
  // Magnetic declination, east positive [deg]; added to magnetic headings.
  double declination_deg = 0.0;
  // Which way roll_deg counts, seen from behind the camera: "clockwise" or "counterclockwise".
  std::string roll_sense = "clockwise";
  // How the device is held: "portrait", or "landscape" (turned left, its top to the left).
  std::string held = "portrait";
  // Heading, pitch and roll: "instruments", or "gyroscope": integrated, and pulled back to the
  // instruments with the time constant (gyroscope.h).
  std::string attitude = "instruments";
  double gyro_time_constant_s = 10.0;
  // Where the height comes from: "dtm" (terrain and camera_height_m), "gnss", or "barometer"
  // (height differences to the first reading with a pressure, which is taken to be at the terrain's
  // height).
  std::string height_source = "dtm";
  double camera_height_m = 1.6;

  void Visit(OptionVisitor& v) {
    v.Field("heading_reference", heading_reference, OneOf{{"grid", "true", "magnetic"}});
    v.Field("declination_deg", declination_deg, Closed(-180.0, 180.0));
    v.Field("roll_sense", roll_sense, OneOf{{"clockwise", "counterclockwise"}});
    v.Field("held", held, OneOf{{"portrait", "landscape"}});
    v.Field("attitude", attitude, OneOf{{"instruments", "gyroscope"}});
    v.Field("gyro_time_constant_s", gyro_time_constant_s, Positive());
    v.Field("height_source", height_source, OneOf{{"dtm", "gnss", "barometer"}});
    v.Field("camera_height_m", camera_height_m, Positive());
  }
};

// Reads a CSV with a header; '#' starts a comment line. Columns: id, time_s, lat_deg, lon_deg,
// alt_m, compass_heading_deg, pitch_deg, roll_deg, acc_x, acc_y, acc_z, gyro_x, gyro_y, gyro_z,
// pressure_hpa, speed_m_s; all but id
// are optional, and empty fields are missing values. Throws InputError naming line and column for
// unknown or repeated columns, rows of a wrong length, values that are not numbers or out of range,
// and two rows with one id.
std::vector<SensorReading> ReadSensors(const std::filesystem::path& path);

// Pitch and roll [deg] from the direction of the acceleration at rest, by the formulas of Ayadi et
// al., section 5.2, in camera axes:
//   pitch = atan(u_z / sqrt(u_x^2 + u_y^2)), roll = atan2(-u_x, -u_y), u: upward.
struct DeviceTilt {
  double pitch_deg = 0.0;
  double roll_deg = 0.0;
};
DeviceTilt TiltFromUpward(const Eigen::Vector3d& upward_in_camera);

// Upward in camera axes from the acceleration in device axes (x to the right and y to the top of
// the screen, z out of it; the camera looks out of the back).
Eigen::Vector3d UpwardInCamera(const Eigen::Vector3d& acceleration, const std::string& held);

// Height difference [m] from one pressure to another, by the barometric formula of the standard
// atmosphere (288.15 K, 0.0065 K/m).
double HeightBetween(double from_hpa, double to_hpa);

// Readings as priors in the model's system.
class SensorPriors {
 public:
  // Throws InputError for options that cannot be used and a system that PROJ does not know.
  SensorPriors(const Crs& crs, const SensorOptions& options);

  // The prior of a reading, in the world frame. nullopt: no position, or no height from the source
  // that was asked for, or no heading; `missing` says which.
  //
  // @param terrain_m  Height of the terrain at a position (world), nullopt: unknown.
  std::optional<PosePrior> PriorOf(
      const SensorReading& reading,
      const std::function<std::optional<double>(const Eigen::Vector2d&)>& terrain_m,
      std::string& missing);

 private:
  std::optional<double> HeightOf(const SensorReading& reading,
                                 std::optional<double> terrain_m,
                                 std::string& missing);
  double GridHeading(const SensorReading& reading) const;
  Eigen::Vector2d Project(double latitude_deg, double longitude_deg) const;

  Crs crs_;
  SensorOptions options_;
  std::optional<double> reference_hpa_;  // pressure and height of the first reading
  double reference_height_m_ = 0.0;
};

}  // namespace ridgeline
