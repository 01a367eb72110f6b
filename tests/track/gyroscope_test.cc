// SPDX-License-Identifier: Apache-2.0
#include "track/gyroscope.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <numbers>

#include "base/atomic_file.h"
#include "base/error.h"
#include "synth/walk.h"

namespace ridgeline {
namespace {

constexpr double kRad = std::numbers::pi / 180.0;

// A phone in portrait, level, that turns to the right by 10 degrees a second: about its downward axis.
std::vector<SensorReading> Turning(double compass_error_deg) {
  std::vector<SensorReading> readings(21);
  for (std::size_t i = 0; i < readings.size(); ++i) {
    SensorReading& r = readings[i];
    r.id = std::to_string(i);
    r.time_s = 0.1 * static_cast<double>(i);
    r.compass_deg = 350.0 + 10.0 * *r.time_s + (i == 0 ? 0.0 : compass_error_deg);
    r.pitch_deg = 0.0;
    r.roll_deg = 0.0;
    // Device axes: y to the top of the screen, upward.
    r.rotation_rad_s = Eigen::Vector3d(0.0, -10.0 * kRad, 0.0);
  }
  return readings;
}

TEST(IntegrateGyroscope, TurnsTheHeadingByTheRates) {
  SensorOptions options;
  options.gyro_time_constant_s = 1e9;  // the gyroscope alone
  const auto fused = IntegrateGyroscope(Turning(40.0), options, "walk.csv");
  EXPECT_NEAR(HeadingDifferenceDeg(*fused.back().compass_deg, 350.0 + 20.0), 0.0, 1e-6);
  EXPECT_NEAR(*fused.back().pitch_deg, 0.0, 1e-6);
  EXPECT_NEAR(*fused.back().roll_deg, 0.0, 1e-6);
}

TEST(IntegrateGyroscope, IsPulledBackWithTheTimeConstant) {
  SensorOptions options;
  options.gyro_time_constant_s = 2.0;
  const auto fused = IntegrateGyroscope(Turning(40.0), options, "walk.csv");
  // After 2 s the compass' error has come in by 1 - (1 - 0.1 / 2.1)^20.
  const double share = 1.0 - std::pow(1.0 - 0.1 / 2.1, 20.0);
  EXPECT_NEAR(HeadingDifferenceDeg(*fused.back().compass_deg, 10.0), 40.0 * share, 0.01);
}

TEST(IntegrateGyroscope, StartsAnewAfterAGap) {
  auto readings = Turning(40.0);
  for (std::size_t i = 10; i < readings.size(); ++i) *readings[i].time_s += 5.0;
  SensorOptions options;
  options.gyro_time_constant_s = 1e9;
  const auto fused = IntegrateGyroscope(readings, options, "walk.csv");
  EXPECT_NEAR(HeadingDifferenceDeg(*fused[10].compass_deg, *readings[10].compass_deg), 0.0, 1e-9);
}

TEST(IntegrateGyroscope, WithoutRatesIsRefused) {
  auto readings = Turning(0.0);
  for (SensorReading& r : readings) r.rotation_rad_s.reset();
  EXPECT_THROW(IntegrateGyroscope(readings, SensorOptions{}, "walk.csv"), InputError);
}

// On a walk of the generator, whose phone has biased rates, the integrated heading changes from frame
// to frame as the true one does, much more so than the compass'.
TEST(IntegrateGyroscope, IsSteadierThanTheCompassOnAWalk) {
  WalkOptions options;
  options.town.blocks_east = options.town.blocks_north = 2;
  options.frames = 80;
  options.compass_noise_deg = 3.0;
  const Town town = MakeTown(options.town);
  const std::vector<Pose> poses = WalkPoses(town, options);
  const auto path = std::filesystem::temp_directory_path() /
                    ("ridgeline_gyro_" + std::to_string(::getpid()) + ".csv");
  WriteFileAtomically(path, WalkSensorsCsv(town, poses, options));
  const std::vector<SensorReading> readings = ReadSensors(path);
  std::filesystem::remove(path);
  SensorOptions sensors;
  sensors.held = "landscape";
  const auto fused = IntegrateGyroscope(readings, sensors, "walk.csv");
  double compass = 0.0, gyroscope = 0.0;
  for (std::size_t i = 1; i < poses.size(); ++i) {
    const auto change = [](double a, double b) { return HeadingDifferenceDeg(b, a); };
    const double truth = change(ViewAnglesOf(poses[i - 1].cam_from_world).heading_deg,
                                ViewAnglesOf(poses[i].cam_from_world).heading_deg);
    compass += std::abs(change(*readings[i - 1].compass_deg, *readings[i].compass_deg) - truth);
    gyroscope += std::abs(change(*fused[i - 1].compass_deg, *fused[i].compass_deg) - truth);
  }
  EXPECT_LT(gyroscope, 0.5 * compass);
}

}  // namespace
}  // namespace ridgeline
