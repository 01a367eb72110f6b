// SPDX-License-Identifier: Apache-2.0
#include "track/sensors.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>

#include "base/atomic_file.h"
#include "base/error.h"

namespace ridgeline {
namespace {

class SensorFile : public ::testing::Test {
 protected:
  std::string ErrorOf(const std::string& text) {
    try {
      Read(text);
    } catch (const InputError& error) {
      return error.what();
    }
    return "no error";
  }
  std::vector<SensorReading> Read(const std::string& text) {
    const auto path = std::filesystem::temp_directory_path() /
                      ("ridgeline_sensors_" + std::to_string(::getpid()) + ".csv");
    WriteFileAtomically(path, text);
    try {
      auto readings = ReadSensors(path);
      std::filesystem::remove(path);
      return readings;
    } catch (...) {
      std::filesystem::remove(path);
      throw;
    }
  }
};

TEST_F(SensorFile, MissingFieldsAreAbsent) {
  const auto readings =
      Read("# comment\nid,lat_deg,lon_deg,compass_heading_deg\r\na,48.1,11.5,\r\nb,,,90\n\n");
  ASSERT_EQ(readings.size(), 2u);
  EXPECT_EQ(readings[0].id, "a");
  EXPECT_EQ(readings[0].latitude_deg, 48.1);
  EXPECT_FALSE(readings[0].compass_deg);
  EXPECT_FALSE(readings[1].latitude_deg);
  EXPECT_EQ(readings[1].compass_deg, 90.0);
}

// As spreadsheets write them; names keep their own blanks.
TEST_F(SensorFile, MarkOfByteOrderQuotesAndBlanks) {
  const auto readings = Read("\xEF\xBB\xBF\"id\",\"lat_deg\"\r\n\"my photo 1\" ,\"48.1\"\r\n");
  ASSERT_EQ(readings.size(), 1u);
  EXPECT_EQ(readings[0].id, "my photo 1");
  EXPECT_EQ(readings[0].latitude_deg, 48.1);
}

TEST_F(SensorFile, ErrorsNameLineAndColumn) {
  EXPECT_NE(ErrorOf("id,lat_degr\n").find("lat_deg"), std::string::npos);
  EXPECT_NE(ErrorOf("id,lat_deg\na,north\n").find("line 2: lat_deg"), std::string::npos);
  EXPECT_NE(ErrorOf("id,lat_deg\na,91\n").find("[-90, 90]"), std::string::npos);
  EXPECT_NE(ErrorOf("id,lat_deg\na,1\na,2\n").find("line 3: id"), std::string::npos);
  EXPECT_NE(ErrorOf("id,lat_deg\na\n").find("1 fields"), std::string::npos);
  EXPECT_NE(ErrorOf("lat_deg\n1\n").find("column id"), std::string::npos);
  EXPECT_NE(ErrorOf("id\n").find("no rows"), std::string::npos);
}

TEST(TiltFromUpward, IsThePitchAndRollOfThePose) {
  for (const ViewAngles angles :
       {ViewAngles{10, 0, 0}, ViewAngles{120, 25, 8}, ViewAngles{300, -15, -40}}) {
    const DeviceTilt tilt = TiltFromUpward(CamFromWorld(angles) * Eigen::Vector3d::UnitZ());
    EXPECT_NEAR(tilt.pitch_deg, angles.pitch_deg, 1e-9);
    EXPECT_NEAR(tilt.roll_deg, angles.roll_deg, 1e-9);
  }
}

TEST(UpwardInCamera, KnowsHowTheDeviceIsHeld) {
  // Upright: gravity's reaction along the screen's top. Image up is -y.
  EXPECT_EQ(UpwardInCamera({0, 9.81, 0}, "portrait"), Eigen::Vector3d(0, -9.81, 0));
  // Turned left, the right edge of the screen points up.
  EXPECT_EQ(UpwardInCamera({9.81, 0, 0}, "landscape"), Eigen::Vector3d(0, -9.81, 0));
  // Flat on its back the camera looks down: up is behind it.
  EXPECT_EQ(UpwardInCamera({0, 0, 9.81}, "portrait"), Eigen::Vector3d(0, 0, -9.81));
}

TEST(HeightBetween, IsTheStandardAtmosphere) {
  // ICAO standard atmosphere: 954.61 hPa at 500 m, 898.75 hPa at 1000 m.
  EXPECT_NEAR(HeightBetween(1013.25, 954.61), 500.0, 0.3);
  EXPECT_NEAR(HeightBetween(1013.25, 898.75), 1000.0, 0.5);
}

class Priors : public ::testing::Test {
 protected:
  std::optional<PosePrior> PriorOf(const SensorReading& reading, const SensorOptions& options) {
    SensorPriors priors({25832, 0}, options);
    return priors.PriorOf(
        reading, [](const Eigen::Vector2d&) { return 500.0; }, missing_);
  }
  static SensorReading Munich() {
    SensorReading r;
    r.id = "a";
    r.latitude_deg = 48.14805842;
    r.longitude_deg = 11.56654131;
    r.altitude_m = 516.0;
    r.compass_deg = 100.0;
    return r;
  }
  std::string missing_;
};

TEST_F(Priors, PositionsAreInTheModelsSystem) {
  SensorOptions options;
  options.heading_reference = "grid";
  const auto prior = PriorOf(Munich(), options);
  ASSERT_TRUE(prior);
  // gdaltransform -s_srs EPSG:4326 -t_srs EPSG:25832.
  EXPECT_NEAR(prior->position_in_world.x(), 690898.6, 5.0);
  EXPECT_NEAR(prior->position_in_world.y(), 5335940.0, 5.0);
  EXPECT_NEAR(*prior->height_in_world, 501.6, 1e-9);
  EXPECT_NEAR(*prior->heading_deg, 100.0, 1e-9);
}

TEST_F(Priors, CompassHeadingsGetDeclinationAndConvergence) {
  SensorOptions options;
  options.heading_reference = "true";
  // Meridian convergence of UTM 32 there: atan(tan(dlon) sin(lat)) = 1.9128 degrees; grid headings
  // east of the central meridian are smaller.
  const double convergence =
      std::atan(std::tan((11.56654131 - 9.0) * M_PI / 180) * std::sin(48.14805842 * M_PI / 180)) *
      180 / M_PI;
  EXPECT_NEAR(*PriorOf(Munich(), options)->heading_deg, 100.0 - convergence, 0.01);
  options.heading_reference = "magnetic";
  options.declination_deg = 4.0;
  EXPECT_NEAR(*PriorOf(Munich(), options)->heading_deg, 104.0 - convergence, 0.01);
}

TEST_F(Priors, HeightsComeFromTheSourceAskedFor) {
  SensorOptions options;
  options.heading_reference = "grid";
  options.height_source = "gnss";
  EXPECT_EQ(PriorOf(Munich(), options)->height_in_world, 516.0);

  options.height_source = "barometer";
  SensorPriors priors({25832, 0}, options);
  const auto terrain = [](const Eigen::Vector2d&) { return std::optional<double>(500.0); };
  SensorReading r = Munich();
  r.pressure_hpa = 950.0;
  EXPECT_NEAR(*priors.PriorOf(r, terrain, missing_)->height_in_world, 501.6, 1e-9);
  r.pressure_hpa = 949.0;
  const double step = *priors.PriorOf(r, terrain, missing_)->height_in_world - 501.6;
  EXPECT_NEAR(step, HeightBetween(950.0, 949.0), 1e-9);
  EXPECT_NEAR(step, 8.8, 0.2);  // about 8.8 m per hPa there
}

TEST_F(Priors, MissingPartsAreNamed) {
  SensorReading r = Munich();
  r.compass_deg.reset();
  EXPECT_FALSE(PriorOf(r, SensorOptions{}));
  EXPECT_EQ(missing_, "compass heading");
  r = Munich();
  r.altitude_m.reset();
  SensorOptions options;
  options.height_source = "gnss";
  EXPECT_FALSE(PriorOf(r, options));
  EXPECT_EQ(missing_, "altitude");
}

TEST_F(Priors, TheAccelerometerGivesTheTilt) {
  SensorReading r = Munich();
  const Eigen::Vector3d up = CamFromWorld(ViewAngles{0.0, 12.0, -5.0}) * Eigen::Vector3d::UnitZ();
  r.acceleration = Eigen::Vector3d(up.x(), -up.y(), -up.z());  // portrait
  const auto prior = PriorOf(r, SensorOptions{});
  EXPECT_NEAR(*prior->pitch_deg, 12.0, 1e-9);
  EXPECT_NEAR(*prior->roll_deg, -5.0, 1e-9);
}

}  // namespace
}  // namespace ridgeline
