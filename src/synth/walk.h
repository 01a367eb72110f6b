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

  void Visit(OptionVisitor& v);
};

// True poses of the frames, in the town's local frame.
std::vector<Pose> WalkPoses(const Town& town, const WalkOptions& options);

// The instruments at these poses as a CSV (track/sensors.h): WGS 84 position, altitude, magnetic
// compass, pitch and roll, acceleration of a phone held in landscape, air pressure.
std::string WalkSensorsCsv(const Town& town,
                           const std::vector<Pose>& cam_from_local,
                           const WalkOptions& options);

// Writes the town and the walk as a dataset into the existing folder `folder`: city.gml, dtm.tif,
// images/frame_*.jpg, sensors.csv, dataset.json with the true poses. Same files for the same
// options on any number of threads.
TownDatasetSummary WriteWalkDataset(const WalkOptions& options,
                                    const std::filesystem::path& folder,
                                    int threads,
                                    const FileProgress& progress);

}  // namespace ridgeline
