// SPDX-License-Identifier: Apache-2.0
#include "input/picture_input.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>

#include "base/atomic_file.h"
#include "base/error.h"
#include "camera/magnetic_declination.h"
#include "input/read_picture.h"
#include "support/exif_writer.h"

namespace ridgeline {
namespace {

using testing::ExifWriter;
using Directory = testing::ExifWriter::Directory;
using ::testing::Contains;
using ::testing::HasSubstr;

const Crs kUtm32{25832, 0};
// By Krueger's series (fourth order) on GRS 80, worked out apart from PROJ.
constexpr double kLatitude = 48.148912;
constexpr double kLongitude = 11.567891;
constexpr double kEast = 690994.2687;
constexpr double kNorth = 5336040.5004;
constexpr double kConvergence = 1.91335;

PictureFacts FactsInMunich() {
  PictureFacts facts;
  facts.place = PictureFacts::Place{kLatitude, kLongitude, "EXIF"};
  return facts;
}

PosePrior PriorFor(const PictureFacts& facts,
                   const std::optional<double>& terrain,
                   PictureInput& input,
                   const PictureInputOptions& options = {}) {
  return PriorOf(facts, kUtm32, "photo.jpg", terrain, options, input).value();
}

TEST(PicturePrior, PlacesLatitudeAndLongitudeInTheGrid) {
  PictureInput input;
  const PosePrior prior = PriorFor(FactsInMunich(), 515.0, input);
  // PROJ and the series agree to a millimetre; WGS 84 and ETRS 89 are taken as one.
  EXPECT_NEAR(prior.position_in_world.x(), kEast, 2e-3);
  EXPECT_NEAR(prior.position_in_world.y(), kNorth, 2e-3);
  EXPECT_FALSE(prior.height_in_world.has_value());
  EXPECT_FALSE(prior.heading_deg.has_value());
  EXPECT_EQ(input.horizontal_m, 10.0);
  EXPECT_THAT(input.notes, Contains(HasSubstr("all directions are searched")));
}

TEST(PicturePrior, TrueNorthIsTurnedToGridNorth) {
  PictureFacts facts = FactsInMunich();
  facts.direction = PictureFacts::Direction{112.0, false, std::nullopt, std::nullopt, "EXIF"};
  PictureInput input;
  EXPECT_NEAR(PriorFor(facts, 515.0, input).heading_deg.value(), 112.0 - kConvergence, 1e-4);
  // West of the central meridian the other way round.
  facts.place->longitude_deg = 8.2;
  EXPECT_NEAR(PriorFor(facts, 515.0, input).heading_deg.value(), 112.0 + 0.59592, 1e-4);
}

TEST(PicturePrior, MagneticNorthIsTurnedByTheDeclination) {
  PictureFacts facts = FactsInMunich();
  facts.direction = PictureFacts::Direction{112.0, true, std::nullopt, std::nullopt, "EXIF"};
  facts.year = 2026.0;
  PictureInput input;
  const double modelled = MagneticDeclinationDeg(kLatitude, kLongitude, 2026.0);
  EXPECT_GT(modelled, 3.5);  // Munich: 4.5 deg east and rising
  EXPECT_LT(modelled, 5.5);
  EXPECT_NEAR(
      PriorFor(facts, 515.0, input).heading_deg.value(), 112.0 + modelled - kConvergence, 1e-4);
  EXPECT_THAT(input.notes, Contains(HasSubstr("World Magnetic Model")));
  PictureInputOptions options;
  options.declination_deg = 4.0;
  EXPECT_NEAR(
      PriorFor(facts, 515.0, input, options).heading_deg.value(), 112.0 + 4.0 - kConvergence, 1e-4);
}

TEST(PicturePrior, HeightsInTheirOrderOfTrust) {
  PictureFacts facts = FactsInMunich();
  facts.altitude_m = 560.0;
  PictureInput by_hand;
  EXPECT_FALSE(PriorFor(facts, 515.0, by_hand).height_in_world.has_value());
  EXPECT_EQ(by_hand.height_m, 0.0);
  PictureInput no_terrain;
  EXPECT_EQ(PriorFor(facts, std::nullopt, no_terrain).height_in_world.value(), 560.0);
  EXPECT_THAT(no_terrain.notes, Contains(HasSubstr("--dtm")));
  facts.altitude_above_takeoff_m = 38.1;
  PictureInput drone;
  EXPECT_NEAR(PriorFor(facts, 515.0, drone).height_in_world.value(), 553.1, 1e-9);
  EXPECT_EQ(drone.height_m, 10.0);
}

// Geoid undulation in Munich by EGM96: 45.6 m.
TEST(PicturePrior, AltitudesThatContradictTheGround) {
  PictureFacts facts = FactsInMunich();
  facts.altitude_m = 635.0;
  PictureInput in_the_air;
  EXPECT_EQ(PriorFor(facts, 515.0, in_the_air).height_in_world.value(), 635.0);
  EXPECT_NEAR(in_the_air.height_m, 55.6, 1.0);
  EXPECT_THAT(in_the_air.notes,
              Contains(HasSubstr("it seems to be taken from the air, 120 m above the terrain")));
  // Meant above the ellipsoid, as some phones do: a receiver on the ground.
  facts.altitude_m = 570.0;
  PictureInput phone;
  EXPECT_FALSE(PriorFor(facts, 515.0, phone).height_in_world.has_value());
  EXPECT_THAT(phone.notes, Contains(HasSubstr("was meant above the ellipsoid, as it seems")));
  facts.altitude_m = 400.0;
  PictureInput below;
  EXPECT_FALSE(PriorFor(facts, 515.0, below).height_in_world.has_value());
  EXPECT_THAT(below.notes, Contains(HasSubstr("115 m below the terrain")));
}

TEST(PicturePrior, AircraftAreNotOnTheGround) {
  PictureFacts facts = FactsInMunich();
  facts.from_aircraft = true;
  PictureInput silent;
  PriorFor(facts, 515.0, silent);
  EXPECT_THAT(silent.notes, Contains(HasSubstr("though an aircraft took the picture")));
  facts.altitude_m = 535.0;
  PictureInput low;
  EXPECT_EQ(PriorFor(facts, 515.0, low).height_in_world.value(), 535.0);
  facts.altitude_m = 480.0;
  PictureInput below;
  const double height = PriorFor(facts, 515.0, below).height_in_world.value();
  EXPECT_EQ(height - below.height_m, 515.0);
  facts.height_above_ground_m = 80.5;
  PictureInput told;
  EXPECT_EQ(PriorFor(facts, 515.0, told).height_in_world.value(), 595.5);
  EXPECT_EQ(told.height_m, 10.0);
}

TEST(PicturePrior, AltitudesAboveTheEllipsoidAreBroughtToSeaLevel) {
  PictureFacts facts = FactsInMunich();
  facts.altitude_m = 600.0;
  facts.altitude_above_ellipsoid = true;
  PictureInput input;
  EXPECT_NEAR(PriorFor(facts, std::nullopt, input).height_in_world.value(), 554.4, 1.0);
  EXPECT_THAT(input.notes, Contains(HasSubstr("m above the ellipsoid = ")));
}

TEST(PicturePrior, DoubtsAreAmongTheNotes) {
  PictureFacts facts = FactsInMunich();
  facts.doubts = {"position: some doubt"};
  PictureInput input;
  PriorFor(facts, 515.0, input);
  EXPECT_THAT(input.notes, Contains("position: some doubt"));
}

TEST(PicturePrior, TheReceiversOwnErrorWidensTheSearch) {
  PictureFacts facts = FactsInMunich();
  facts.horizontal_error_m = 14.0;
  PictureInput input;
  PriorFor(facts, 515.0, input);
  EXPECT_EQ(input.horizontal_m, 28.0);
  facts.horizontal_error_m = 500.0;
  PriorFor(facts, 515.0, input);
  EXPECT_EQ(input.horizontal_m, 40.0);
}

TEST(PicturePrior, WithoutPlaceThereIsNone) {
  PictureInput input;
  EXPECT_FALSE(PriorOf({}, kUtm32, "photo.jpg", 515.0, {}, input).has_value());
}

TEST(PicturePrior, ModelWithoutSystemAsksForOne) {
  PictureInput input;
  try {
    PriorOf(FactsInMunich(), Crs{}, "photo.jpg", 515.0, {}, input);
    FAIL();
  } catch (const InputError& e) {
    EXPECT_THAT(e.what(), HasSubstr("--crs"));
  }
}

// A picture file of 40 x 30 px stored on its side.
class PictureOnItsSide : public ::testing::Test {
 protected:
  PictureOnItsSide() {
    std::vector<uchar> jpeg;
    cv::imencode(".jpg", cv::Mat(30, 40, CV_8UC3, cv::Scalar(90, 120, 150)), jpeg);
    ExifWriter exif;
    exif.Short(Directory::kImage, 0x0112, 6)
        .Short(Directory::kPhoto, 0xa405, 26)
        .Text(Directory::kGps, 1, "N")
        .Ratios(Directory::kGps, 2, {{48148912, 1000000}, {0, 1}, {0, 1}})
        .Text(Directory::kGps, 3, "E")
        .Ratios(Directory::kGps, 4, {{11567891, 1000000}, {0, 1}, {0, 1}});
    WriteFileAtomically(path_,
                        testing::JpegWith(std::string(jpeg.begin(), jpeg.end()), exif.Block(), ""));
    query_.id = "side";
    query_.image = path_;
  }
  ~PictureOnItsSide() override { std::filesystem::remove(path_); }

  PictureReader pictures_;

  std::filesystem::path path_ = std::filesystem::path(::testing::TempDir()) /
                                ("ridgeline_picture_input_" + std::to_string(::getpid()) + ".jpg");
  Query query_;
};

TEST_F(PictureOnItsSide, IsTurnedWithTheCameraItTells) {
  const PictureInput input = ReadPictureInput(query_, kUtm32, std::nullopt, {}, pictures_);
  ASSERT_TRUE(input.camera.has_value());
  EXPECT_EQ(input.camera->width, 30);
  EXPECT_EQ(input.camera->height, 40);
  EXPECT_FALSE(input.prior->roll_deg.has_value());
  query_.camera = input.camera;
  query_.orientation = input.orientation;
  const cv::Mat picture = ReadPicture(query_);
  EXPECT_EQ(picture.cols, 30);
  EXPECT_EQ(picture.rows, 40);
}

TEST_F(PictureOnItsSide, IsNotTurnedWithACameraOfItsOwn) {
  query_.camera = CameraIntrinsics{"SIMPLE_PINHOLE", 40, 30, {30.0, 20.0, 15.0}};
  const PictureInput input = ReadPictureInput(query_, kUtm32, std::nullopt, {}, pictures_);
  EXPECT_FALSE(input.camera.has_value());
  EXPECT_EQ(input.orientation, 1);
  EXPECT_EQ(input.prior->roll_deg.value(), 90.0);
  EXPECT_EQ(ReadPicture(query_).cols, 40);
}

TEST_F(PictureOnItsSide, IsDecodedOnce) {
  EXPECT_EQ(pictures_.Read(query_).cols, 40);
  std::filesystem::remove(path_);
  query_.orientation = 6;
  EXPECT_EQ(pictures_.Read(query_).cols, 30);
  EXPECT_THROW(PictureReader().Read(query_), InputError);
}

}  // namespace
}  // namespace ridgeline
