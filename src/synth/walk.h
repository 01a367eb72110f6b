// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "base/options.h"
#include "camera/intrinsics.h"
#include "camera/pose.h"
#include "synth/town.h"
#include "synth/town_dataset.h"

namespace ridgeline {

// Errors of the relative poses in odometry.csv.
struct OdometryErrors {
  // Factor on all distances; 1: right.
  double scale = 1.0;
  // Noise of each step: share of its length, and per step of heading [deg], pitch and roll a third
  // of it.
  double noise_share = 0.02;
  double heading_noise_deg = 0.1;
  // Heading that runs away [deg/s].
  double drift_deg_s = 0.05;

  void Visit(OptionVisitor& v);
};

// What befalls the receiver, in seconds from the first frame; negative: never.
struct GnssTrouble {
  double outage_from_s = -1.0;
  double outage_to_s = -1.0;
  // From then on all positions are off by so much, in a direction drawn.
  double jump_at_s = -1.0;
  double jump_m = 30.0;
  // From then on the positions are dragged off at this speed, in a direction drawn.
  double spoof_from_s = -1.0;
  double spoof_m_s = 0.5;
  // White noise of each fix, east and north, beside the drifting error of the walk.
  double noise_m = 0.0;

  void Visit(OptionVisitor& v);
};

// A hand-held walk through a town, filmed with a phone, and the errors of the phone's instruments.
struct WalkOptions {
  TownOptions town;
  int frames = 60;
  double frames_per_second = 5.0;
  int width = 640;
  int height = 480;
  double horizontal_fov_deg = 60.0;
  int jpeg_quality = 90;
  double speed_m_s = 1.3;
  // Mean upward tilt of the phone [deg].
  double pitch_deg = 6.0;
  // As of TownDatasetOptions.
  double overhang_m = 0.3;
  double survey_sigma_m = 0.05;
  // Compass: a drifting error within +- this, and its noise; declination at the place [deg].
  double compass_error_deg = 13.0;
  double compass_noise_deg = 1.0;
  double declination_deg = 4.0;
  // GNSS: a drifting error of a length between these two [m].
  double gnss_error_low_m = 5.0;
  double gnss_error_high_m = 10.0;
  // Altitude: noise, and jumps of up to this in one frame out of ten [m].
  double altitude_noise_m = 2.0;
  double altitude_jump_m = 30.0;
  // Pitch and roll by gyroscope and accelerometer: slow error, sigma [deg].
  double tilt_sigma_deg = 0.6;
  // Accelerometer noise on each axis while walking [m/s^2].
  double acceleration_noise = 0.15;
  double pressure_noise_hpa = 0.03;
  // Gyroscope: sigma of its bias and of its noise [rad/s].
  double gyro_bias = 0.003;
  double gyro_noise = 0.01;
  // Height of the camera above the ground.
  double eye_height_m = 1.6;
  // How far the camera looks around, and how unsteadily it is held [deg]; 0 on a vehicle.
  double look_deg = 25.0;
  double hand_deg = 2.0;
  // Up and down from step to step.
  double bob_m = 0.03;
  OdometryErrors odometry;
  GnssTrouble gnss;

  void Visit(OptionVisitor& v);
};

// A car's camera: 720p, level, looking ahead, 2 frames a second at 8 m/s.
WalkOptions DriveDefaults();
// A drone along the streets, 50 m up and looking down ahead.
WalkOptions FlightDefaults();

// True poses of the frames, in the town's local frame.
std::vector<Pose> WalkPoses(const Town& town, const WalkOptions& options);

// The instruments at these poses as a CSV (track/sensors.h): WGS 84 position, altitude, magnetic
// compass, pitch and roll, acceleration of a phone held in landscape, air pressure.
std::string WalkSensorsCsv(const Town& town,
                           const std::vector<Pose>& cam_from_local,
                           const WalkOptions& options);

// Odometry between the frames as a CSV (track/odometry.h): from the second frame on, the pose of
// each in the axes of the one before, with standard deviations.
std::string WalkOdometryCsv(const std::vector<Pose>& cam_from_local, const WalkOptions& options);

// Writes the town and the walk as a dataset into the existing folder `folder`: city.gml, dtm.tif,
// images/frame_*.jpg, sensors.csv, odometry.csv, dataset.json with the true poses. Same files for the same
// options on any number of threads.
TownDatasetSummary WriteWalkDataset(const WalkOptions& options,
                                    const std::filesystem::path& folder,
                                    int threads,
                                    const FileProgress& progress);

}  // namespace ridgeline
