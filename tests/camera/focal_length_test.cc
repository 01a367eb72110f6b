// SPDX-License-Identifier: Apache-2.0
#include "camera/focal_length.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "camera/sensor_width.h"

namespace ridgeline {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using Size = PictureFacts::Size;

double Best(const PictureFacts& facts, int width, int height) {
  return FocalLengthOf(facts, width, height).hypotheses.front().focal_px;
}

// Whether one of the hypotheses is within a part of a focal length.
bool Holds(const FocalLength& focal, double focal_px, double part) {
  return std::any_of(focal.hypotheses.begin(), focal.hypotheses.end(), [&](const auto& h) {
    return std::abs(h.focal_px / focal_px - 1.0) <= part;
  });
}

// DJI FC6310: 3666.67 px at 5472 x 3648, the picture scaled to a quarter. OpenSfM's calibration of
// such pictures (orthority's test data) is 911.7 px.
TEST(FocalLength, CalibrationBelongsToItsOwnSize) {
  PictureFacts facts;
  facts.calibration = PictureFacts::Calibration{3666.666504, Size{5472, 3648}};
  EXPECT_NEAR(Best(facts, 1368, 912), 916.67, 0.01);
  EXPECT_NEAR(Best(facts, 912, 1368), 916.67, 0.01);    // turned
  EXPECT_NEAR(Best(facts, 5472, 3078), 3666.67, 0.01);  // cut to 16 : 9
  EXPECT_NEAR(Best(facts, 2736, 1539), 1833.33, 0.01);  // and resized
  facts.calibration->size.reset();
  facts.recorded = Size{5472, 3648};
  EXPECT_NEAR(Best(facts, 1368, 912), 916.67, 0.01);
}

TEST(FocalLength, CalibrationInMillimetresIsNoNumberOfPixels) {
  PictureFacts facts;
  facts.calibration = PictureFacts::Calibration{8.8, std::nullopt};
  facts.focal_35mm = 24.0;
  FocalLength focal = FocalLengthOf(facts, 1368, 912);
  EXPECT_NEAR(focal.hypotheses.front().focal_px, 912.0, 0.1);
  EXPECT_THAT(focal.notes, Contains(HasSubstr("no number of pixels; taken as mm")));
  // With a sensor that is known it is a focal length like another.
  facts.focal_35mm.reset();
  facts.camera = "FC6310";
  EXPECT_NEAR(Best(facts, 1368, 912), 8.8 / 13.2 * 1368, 1e-9);
}

// A calibration without its size, on a resized picture: two others agree against it.
TEST(FocalLength, CalibrationOfAnUnknownSizeGivesWay) {
  PictureFacts facts;
  facts.calibration = PictureFacts::Calibration{3666.67, std::nullopt};
  facts.focal_35mm = 24.0;
  const FocalLength focal = FocalLengthOf(facts, 1368, 912);
  EXPECT_NEAR(focal.hypotheses.front().focal_px, 912.0, 0.1);
  EXPECT_TRUE(Holds(focal, 3666.67, 1e-6));
  EXPECT_THAT(focal.notes, Contains(HasSubstr("the other is the more plausible")));
}

// exiftool's FocalLength35efl x diagonal: 37 mm at 155.9 px/mm, the pixels turned by a viewer.
TEST(FocalLength, PlaneResolutionOfATurnedPicture) {
  PictureFacts facts;
  facts.focal_mm = 37.0;
  facts.plane_px_per_mm = 233600.0 / 59.0 / 25.4;
  facts.recorded = Size{3504, 2336};
  EXPECT_NEAR(Best(facts, 1168, 1752), 2884.0, 1.0);
}

// The recorded size rewritten, the resolution not: a sensor 7.7 mm wide in a Canon EOS 60D.
TEST(FocalLength, TheModelsSensorGoesBeforeThePlane) {
  PictureFacts facts;
  facts.camera = "Canon EOS 60D";
  facts.focal_mm = 28.0;
  facts.plane_px_per_mm = 647284.0 / 113.0 / 25.4;
  facts.recorded = Size{1728, 1152};
  const FocalLength focal = FocalLengthOf(facts, 1728, 1152);
  EXPECT_NEAR(focal.hypotheses.front().focal_px, 2169.7, 0.1);
  EXPECT_THAT(focal.notes, Contains(HasSubstr("a sensor 7.66 mm wide")));
}

TEST(FocalLength, AbsurdPlaneResolutionIsNoCamera) {
  PictureFacts facts;
  facts.focal_mm = 2.4;
  facts.plane_px_per_mm = 4.202;
  facts.recorded = Size{3600, 2400};
  const FocalLength focal = FocalLengthOf(facts, 600, 400);
  EXPECT_TRUE(focal.assumed);
  EXPECT_NEAR(focal.hypotheses.front().focal_px, 26.0 * 721.11 / 43.2666, 0.1);
  EXPECT_THAT(focal.notes, Contains(HasSubstr("a field of view of 179")));
}

// MicaSense's TIFF files do not tell the recorded size.
TEST(FocalLength, PlaneResolutionWithoutRecordedSize) {
  PictureFacts facts;
  facts.focal_mm = 5.5;
  facts.plane_px_per_mm = 289.855;
  const FocalLength focal = FocalLengthOf(facts, 1456, 1088);
  EXPECT_NEAR(focal.hypotheses.front().focal_px, 1594.2, 0.1);
  EXPECT_FALSE(focal.assumed);
}

// A compact's picture that an editor made small: no sensor is 2 mm wide.
TEST(FocalLength, ResolutionOfAResizedCompactIsDoubted) {
  PictureFacts facts;
  facts.focal_mm = 7.4;
  facts.plane_px_per_mm = 319.0;
  facts.recorded = Size{640, 480};
  const FocalLength focal = FocalLengthOf(facts, 640, 480);
  EXPECT_TRUE(focal.assumed);
  EXPECT_NEAR(focal.hypotheses.front().focal_px, 7.4 / 6.2 * 640, 1e-9);
  EXPECT_THAT(focal.notes, Contains(HasSubstr("no camera has a sensor 2.01 mm wide")));
  facts.camera = "Canon PowerShot S40";
  EXPECT_NEAR(Best(facts, 640, 480), 7.4 / 7.18 * 640, 1e-9);
}

PictureFacts Zoomed(const char* make, const char* model, double equivalent, double zoom) {
  PictureFacts facts;
  facts.make = make;
  facts.camera = model;
  facts.focal_35mm = equivalent;
  facts.zoom = zoom;
  return facts;
}

TEST(FocalLength, MakersEquivalentsAndTheDigitalZoom) {
  const double diagonals = std::hypot(4000.0, 3000.0) / 43.266615;
  // exiftool's Google.jpg: 24 / 6.9 is the Pixel's own factor, without the zoom.
  const FocalLength google = FocalLengthOf(Zoomed("Google", "Pixel 8 Pro", 24, 2.0), 4000, 3000);
  EXPECT_NEAR(google.hypotheses.front().focal_px, 48.0 * diagonals, 0.01);
  EXPECT_EQ(google.hypotheses.size(), 1u);
  // exif-samples' iPhone: 57 / 3.99 is twice the iPhone's factor.
  const FocalLength apple = FocalLengthOf(Zoomed("Apple", "iPhone 7", 57, 1.97), 4000, 3000);
  EXPECT_NEAR(apple.hypotheses.front().focal_px, 57.0 * diagonals, 0.01);
  EXPECT_EQ(apple.hypotheses.size(), 1u);
  // Of others it is not known.
  const FocalLength other = FocalLengthOf(Zoomed("Maker", "One", 24, 2.0), 4000, 3000);
  EXPECT_EQ(other.hypotheses.size(), 2u);
  EXPECT_TRUE(Holds(other, 24.0 * diagonals, 1e-6));
  EXPECT_TRUE(Holds(other, 48.0 * diagonals, 1e-6));
  EXPECT_THAT(other.notes, Contains(HasSubstr("both are possible")));
}

// The sensor tells where the maker is not known: 50 mm on a sensor 23.5 mm wide are 77 mm.
TEST(FocalLength, TheSensorTellsWhetherTheZoomIsIn) {
  PictureFacts facts = Zoomed("SONY", "ILCE-6000", 77, 2.0);
  facts.focal_mm = 50.0;
  FocalLength focal = FocalLengthOf(facts, 6000, 4000);
  EXPECT_EQ(focal.hypotheses.size(), 1u);
  EXPECT_NEAR(focal.hypotheses.front().focal_px, 50.0 / 23.5 * 6000 * 2, 300);
  facts.focal_35mm = 154.0;
  focal = FocalLengthOf(facts, 6000, 4000);
  EXPECT_EQ(focal.hypotheses.size(), 1u);
  EXPECT_NEAR(focal.hypotheses.front().focal_px, 50.0 / 23.5 * 6000 * 2, 300);
}

// Calibrated photos of a Samsung SM-S906U1, 4000 x 3000, whose EXIF says 23 mm throughout.
TEST(FocalLength, SamsungsZoomedPhotosAgainstTheirCalibration) {
  struct Photo {
    double zoom;
    double calibrated_px;
  };
  for (const Photo& photo : {Photo{1.0, 2691}, Photo{1.09, 2936}, Photo{1.44, 3854}}) {
    PictureFacts facts = Zoomed("samsung", "SM-S906U1", 23, photo.zoom);
    if (photo.zoom == 1.0) facts.zoom.reset();
    EXPECT_TRUE(Holds(FocalLengthOf(facts, 4000, 3000), photo.calibrated_px, 0.015)) << photo.zoom;
  }
  // One photo, whose calibration is the least sure: within two standard deviations.
  const FocalLength far = FocalLengthOf(Zoomed("samsung", "SM-S906U1", 23, 2.41), 4000, 3000);
  const FocalHypothesis& best = far.hypotheses.front();
  EXPECT_LT(std::abs(best.focal_px / 6140.0 - 1.0), 0.02 * best.sigma_percent);
}

// Canon PowerShot A720 IS, exiftool's pictures: 5.8 mm, 571 px/mm, zoom not contained; S40: 7.1 mm,
// 872 px/mm = 319 x 2.73, contained.
TEST(FocalLength, PlaneResolutionsAndTheDigitalZoom) {
  PictureFacts facts;
  facts.focal_mm = 5.8;
  facts.plane_px_per_mm = 14506.0 / 25.4;
  facts.recorded = Size{3264, 2448};
  facts.zoom = 51.0 / 32.0;
  EXPECT_NEAR(Best(facts, 1632, 1224), 2639.0, 1.0);
  facts.focal_mm = 7.1;
  facts.plane_px_per_mm = 872.0;
  facts.recorded = Size{2272, 1704};
  facts.zoom = 2.73;
  EXPECT_NEAR(Best(facts, 2272, 1704), 7.1 * 872.0, 1e-6);
  facts.camera = "Canon PowerShot S40";
  EXPECT_NEAR(Best(facts, 2272, 1704), 7.1 / 7.18 * 2272 * 2.73, 1e-6);
}

TEST(FocalLength, EquivalentBelowTheFocalLengthIsNone) {
  PictureFacts facts;
  facts.focal_mm = 50.0;
  facts.focal_35mm = 4.0;
  facts.camera = "NIKON D90";
  const FocalLength focal = FocalLengthOf(facts, 4288, 2848);
  EXPECT_NEAR(focal.hypotheses.front().focal_px, 50.0 / 23.6 * 4288, 1e-9);
  EXPECT_THAT(focal.notes, Contains(HasSubstr("less than the focal length itself")));
}

TEST(FocalLength, TwoThatAgreeGoBeforeOne) {
  PictureFacts facts;
  facts.focal_mm = 28.0;
  facts.focal_35mm = 100.0;  // of another lens
  facts.camera = "Canon EOS 60D";
  facts.plane_px_per_mm = 5184.0 / 22.3;
  facts.recorded = Size{5184, 3456};
  const FocalLength focal = FocalLengthOf(facts, 5184, 3456);
  EXPECT_NEAR(focal.hypotheses.front().focal_px, 28.0 / 22.3 * 5184, 1e-6);
  EXPECT_EQ(focal.hypotheses.size(), 2u);
}

// 16 : 9 out of a sensor of 4 : 3 keeps its pixels and its equivalent.
TEST(FocalLength, UnusualShapesMayBeCutOutOfTheSensor) {
  PictureFacts facts;
  facts.focal_35mm = 26.0;
  const FocalLength wide = FocalLengthOf(facts, 4032, 2268);
  EXPECT_NEAR(wide.hypotheses.front().focal_px, 26.0 * std::hypot(4032, 2268) / 43.266615, 0.01);
  EXPECT_TRUE(Holds(wide, 26.0 * 5040.0 / 43.266615, 1e-6));
  EXPECT_TRUE(Holds(FocalLengthOf(facts, 3024, 3024), 26.0 * 5040.0 / 43.266615, 1e-6));
  EXPECT_EQ(FocalLengthOf(facts, 4032, 3024).hypotheses.size(), 1u);
}

// A piece cut out of a recorded picture: as it is, or the whole width made small.
TEST(FocalLength, CutPicturesHaveTwoHypotheses) {
  PictureFacts facts;
  facts.focal_35mm = 26.0;
  facts.recorded = Size{4032, 3024};
  const double whole = 26.0 * 5040.0 / 43.266615;
  const FocalLength focal = FocalLengthOf(facts, 2016, 1000);
  EXPECT_TRUE(Holds(focal, whole, 1e-6));
  EXPECT_TRUE(Holds(focal, 0.5 * whole, 1e-6));
}

TEST(FocalLength, FieldsOfViewOfNoCameraAreDropped) {
  EXPECT_FALSE(IsPlausibleFocal(24.0, 640, 480));  // millimetres
  EXPECT_FALSE(IsPlausibleFocal(0.85, 640, 480));  // of the width
  EXPECT_FALSE(IsPlausibleFocal(10000.0, 640, 480));
  EXPECT_TRUE(IsPlausibleFocal(481.0, 640, 480));
  EXPECT_FALSE(IsPlausibleFocal(std::nan(""), 640, 480));
  for (const double odd : {1e-300, 1e300}) {
    PictureFacts facts;
    facts.focal_35mm = facts.focal_mm = facts.plane_px_per_mm = facts.zoom = odd;
    facts.recorded = Size{odd, odd};
    facts.calibration = PictureFacts::Calibration{odd, Size{odd, odd}};
    const FocalLength focal = FocalLengthOf(facts, 640, 480);
    ASSERT_FALSE(focal.hypotheses.empty());
    for (const FocalHypothesis& h : focal.hypotheses) {
      EXPECT_TRUE(IsPlausibleFocal(h.focal_px, 640, 480)) << h.reason;
    }
  }
}

TEST(SensorWidth, ModelsWhateverTheirCapitals) {
  EXPECT_EQ(SensorWidthMm("Canon EOS 60D"), 22.3);
  EXPECT_EQ(SensorWidthMm("CANON EOS 60D"), 22.3);
  EXPECT_FALSE(SensorWidthMm("Canon EOS").has_value());
  EXPECT_FALSE(SensorWidthMm("").has_value());
}

}  // namespace
}  // namespace ridgeline
