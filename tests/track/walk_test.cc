// SPDX-License-Identifier: Apache-2.0
#include "synth/walk.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>

#include "base/atomic_file.h"
#include "track/sensors.h"

namespace ridgeline {
namespace {

WalkOptions Options() {
  WalkOptions options;
  options.town.blocks_east = options.town.blocks_north = 2;
  options.frames = 200;
  return options;
}

TEST(WalkPoses, StayOutOfBuildingsAtEyeHeight) {
  const WalkOptions options = Options();
  const Town town = MakeTown(options.town);
  const std::vector<Pose> poses = WalkPoses(town, options);
  ASSERT_EQ(poses.size(), 200u);
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const Eigen::Vector3d& p = poses[i].center_in_world;
    EXPECT_FALSE(town.InBuilding(p.head<2>(), 0.5)) << "frame " << i;
    EXPECT_NEAR(p.z() - town.TerrainHeight(p.head<2>()), 1.6, 0.05);
    if (i == 0) continue;
    // A walk: no frame farther from the last than a quick step, corners of the way included.
    EXPECT_LT((p - poses[i - 1].center_in_world).norm(), 4.0);
  }
}

// Sensors read back as priors are the true poses but for the errors asked for.
TEST(WalkSensors, ErrorsAreAsAskedFor) {
  const WalkOptions options = Options();
  const Town town = MakeTown(options.town);
  const std::vector<Pose> poses = WalkPoses(town, options);
  const auto path = std::filesystem::temp_directory_path() /
                    ("ridgeline_walk_" + std::to_string(::getpid()) + ".csv");
  WriteFileAtomically(path, WalkSensorsCsv(town, poses, options));
  const std::vector<SensorReading> readings = ReadSensors(path);
  std::filesystem::remove(path);
  ASSERT_EQ(readings.size(), poses.size());

  SensorOptions sensors;
  sensors.declination_deg = options.declination_deg;
  sensors.held = "landscape";
  SensorPriors priors({town.epsg, 0}, sensors);
  const auto terrain = [](const Eigen::Vector2d&) { return std::optional<double>(0.0); };
  for (std::size_t i = 0; i < poses.size(); i += 10) {
    std::string missing;
    const auto prior = priors.PriorOf(readings[i], terrain, missing);
    ASSERT_TRUE(prior) << missing;
    const ViewAngles truth = ViewAnglesOf(poses[i].cam_from_world);
    const Eigen::Vector2d shift =
        prior->position_in_world - (poses[i].center_in_world + town.origin_in_world).head<2>();
    EXPECT_GT(shift.norm(), options.gnss_error_low_m - 0.01);
    EXPECT_LT(shift.norm(), options.gnss_error_high_m + 0.01);
    EXPECT_LT(std::abs(HeadingDifferenceDeg(*prior->heading_deg, truth.heading_deg)),
              options.compass_error_deg + 5.0 * options.compass_noise_deg);
    EXPECT_NEAR(*prior->pitch_deg, truth.pitch_deg, 5.0 * options.tilt_sigma_deg);
    const DeviceTilt tilt = TiltFromUpward(UpwardInCamera(*readings[i].acceleration, sensors.held));
    EXPECT_NEAR(tilt.pitch_deg, truth.pitch_deg, 5.0);
    EXPECT_NEAR(tilt.roll_deg, truth.roll_deg, 5.0);
  }
}

TEST(WalkSensors, AreTheSameForTheSameSeed) {
  const WalkOptions options = Options();
  const Town town = MakeTown(options.town);
  const std::vector<Pose> poses = WalkPoses(town, options);
  EXPECT_EQ(WalkSensorsCsv(town, poses, options), WalkSensorsCsv(town, poses, options));
}

}  // namespace
}  // namespace ridgeline
