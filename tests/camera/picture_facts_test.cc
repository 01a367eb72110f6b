// SPDX-License-Identifier: Apache-2.0
#include "camera/picture_facts.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/core.hpp>

#include "camera/picture_camera.h"
#include "camera/pose.h"
#include "support/exif_writer.h"
#include "support/xmp_writer.h"

namespace ridgeline {
namespace {

using testing::ExifWriter;
using testing::XmpPacket;
using Directory = testing::ExifWriter::Directory;
using ::testing::HasSubstr;

// What a phone writes in Munich: 48 deg 8' 55.3123", 11 deg 34' 4.4076".
ExifWriter Phone(bool big_endian = false) {
  ExifWriter exif(big_endian);
  exif.Text(Directory::kImage, 0x010f, "Apple")
      .Text(Directory::kImage, 0x0110, "iPhone 12")
      .Short(Directory::kImage, 0x0112, 6)
      .Text(Directory::kPhoto, 0x9003, "2025:07:01 12:00:00")
      .Ratios(Directory::kPhoto, 0x920a, {{42, 10}})
      .Short(Directory::kPhoto, 0xa405, 26)
      .Text(Directory::kGps, 1, "N")
      .Ratios(Directory::kGps, 2, {{48, 1}, {8, 1}, {553123, 10000}})
      .Text(Directory::kGps, 3, "E")
      .Ratios(Directory::kGps, 4, {{11, 1}, {34, 1}, {44076, 10000}})
      .Byte(Directory::kGps, 5, 0)
      .Ratios(Directory::kGps, 6, {{517123, 1000}})
      .Text(Directory::kGps, 16, "M")
      .Ratios(Directory::kGps, 17, {{1123456, 10000}})
      .Ratios(Directory::kGps, 31, {{47, 10}});
  return exif;
}

PictureFacts FactsOfXmp(const std::string& xmp) { return FactsOf({}, ParseXmp(xmp)); }

// As a DJI aircraft writes it: signs before all numbers, the longitude's name misspelt.
std::string Dji(const std::string& yaw, const std::string& pitch, const std::string& roll) {
  return XmpPacket(
      "xmlns:drone-dji=\"http://www.dji.com/drone-dji/1.0/\" "
      "drone-dji:AbsoluteAltitude=\"+556.27\" drone-dji:RelativeAltitude=\"+38.10\" "
      "drone-dji:GpsLatitude=\"48.148912\" drone-dji:GpsLongtitude=\"11.567891\" "
      "drone-dji:GimbalRollDegree=\"" +
      roll + "\" drone-dji:GimbalYawDegree=\"" + yaw + "\" drone-dji:GimbalPitchDegree=\"" + pitch +
      "\" "
      "drone-dji:FlightYawDegree=\"-160.00\" drone-dji:CamReverse=\"0\"");
}

std::string Pix4d(double yaw, double pitch, double roll) {
  return XmpPacket("xmlns:Camera=\"http://pix4d.com/camera/1.0/\" Camera:Yaw=\"" +
                   std::to_string(yaw) + "\" Camera:Pitch=\"" + std::to_string(pitch) +
                   "\" Camera:Roll=\"" + std::to_string(roll) + "\"");
}

Eigen::Quaterniond RotationOf(const PictureFacts& facts) {
  return CamFromWorld(ViewAngles{facts.direction->heading_deg,
                                 facts.direction->pitch_deg.value(),
                                 facts.direction->roll_deg.value()});
}

TEST(PictureFacts, ReadsAPhonesExifInBothByteOrders) {
  for (const bool big_endian : {false, true}) {
    const PictureFacts facts = FactsOf(ParseExif(Phone(big_endian).Block()), {});
    EXPECT_EQ(facts.make, "Apple");
    EXPECT_EQ(facts.camera, "iPhone 12");
    EXPECT_EQ(facts.orientation, 6);
    ASSERT_TRUE(facts.place.has_value());
    EXPECT_DOUBLE_EQ(facts.place->latitude_deg, 48.0 + 8.0 / 60.0 + 55.3123 / 3600.0);
    EXPECT_DOUBLE_EQ(facts.place->longitude_deg, 11.0 + 34.0 / 60.0 + 4.4076 / 3600.0);
    EXPECT_DOUBLE_EQ(facts.altitude_m.value(), 517.123);
    EXPECT_FALSE(facts.altitude_above_ellipsoid);
    EXPECT_DOUBLE_EQ(facts.direction->heading_deg, 112.3456);
    EXPECT_TRUE(facts.direction->magnetic);
    EXPECT_FALSE(facts.direction->pitch_deg.has_value());
    EXPECT_DOUBLE_EQ(facts.horizontal_error_m.value(), 4.7);
    EXPECT_NEAR(facts.year.value(), 2025.54, 0.01);
    EXPECT_EQ(facts.focal_35mm.value(), 26.0);
  }
}

// Some programs write degrees with all their decimals, and nothing else: six digits would be
// metres.
TEST(PictureFacts, KeepsTheDigitsOfDecimalDegrees) {
  ExifWriter exif;
  exif.Text(Directory::kGps, 1, "S")
      .Ratios(Directory::kGps, 2, {{338567891, 10000000}, {0, 1}, {0, 1}})
      .Text(Directory::kGps, 3, "W")
      .Ratios(Directory::kGps, 4, {{706483217, 10000000}});
  const PictureFacts facts = FactsOf(ParseExif(exif.Block()), {});
  EXPECT_DOUBLE_EQ(facts.place->latitude_deg, -33.8567891);
  EXPECT_DOUBLE_EQ(facts.place->longitude_deg, -70.6483217);
}

TEST(PictureFacts, AltitudeHasItsReference) {
  const auto altitude = [](std::uint8_t reference) {
    ExifWriter exif;
    exif.Byte(Directory::kGps, 5, reference).Ratios(Directory::kGps, 6, {{42, 1}});
    return FactsOf(ParseExif(exif.Block()), {});
  };
  EXPECT_EQ(altitude(0).altitude_m, 42.0);
  EXPECT_EQ(altitude(1).altitude_m, -42.0);
  EXPECT_TRUE(altitude(2).altitude_above_ellipsoid);
  EXPECT_EQ(altitude(3).altitude_m, -42.0);
}

TEST(PictureFacts, NoFixIsNoPlace) {
  ExifWriter zeros;
  zeros.Ratios(Directory::kGps, 2, {{0, 1}, {0, 1}, {0, 1}})
      .Ratios(Directory::kGps, 4, {{0, 1}, {0, 1}, {0, 1}});
  EXPECT_FALSE(FactsOf(ParseExif(zeros.Block()), {}).place.has_value());
  ExifWriter nothing;
  nothing.Ratios(Directory::kGps, 2, {{0, 0}, {0, 0}, {0, 0}})
      .Ratios(Directory::kGps, 4, {{0, 0}, {0, 0}, {0, 0}})
      .Ratios(Directory::kGps, 17, {{0, 0}});
  const PictureFacts facts = FactsOf(ParseExif(nothing.Block()), {});
  EXPECT_FALSE(facts.place.has_value());
  EXPECT_FALSE(facts.direction.has_value());
}

TEST(PictureFacts, DamagedExifGivesWhatIsWhole) {
  const std::string block = Phone().Block();
  for (std::size_t size = 0; size < block.size(); ++size) {
    const PictureFacts facts = FactsOf(ParseExif(block.substr(0, size)), {});
    if (!facts.place) continue;
    EXPECT_NEAR(facts.place->latitude_deg, 48.15, 0.01);
  }
  // Offsets and counts from beyond the block.
  std::string wild = block;
  for (std::size_t i = 8; i < wild.size(); ++i) {
    std::string flipped = wild;
    flipped[i] = '\xff';
    FactsOf(ParseExif(flipped), {});
  }
}

TEST(PictureFacts, ReadsDjisGimbal) {
  const PictureFacts facts = FactsOfXmp(Dji("-163.20", "-30.00", "+0.00"));
  EXPECT_DOUBLE_EQ(facts.place->latitude_deg, 48.148912);
  EXPECT_DOUBLE_EQ(facts.place->longitude_deg, 11.567891);
  EXPECT_DOUBLE_EQ(facts.altitude_m.value(), 556.27);
  EXPECT_DOUBLE_EQ(facts.altitude_above_takeoff_m.value(), 38.1);
  EXPECT_NEAR(facts.direction->heading_deg, 196.8, 1e-9);
  EXPECT_NEAR(facts.direction->pitch_deg.value(), -30.0, 1e-9);
  EXPECT_NEAR(facts.direction->roll_deg.value(), 0.0, 1e-9);
  EXPECT_FALSE(facts.direction->magnetic);
}

TEST(PictureFacts, DecimalCommasOfXmp) {
  const PictureFacts facts = FactsOfXmp(Dji("-163,20", "-30,50", "+0,25"));
  EXPECT_NEAR(facts.direction->heading_deg, 196.8, 1e-9);
  EXPECT_NEAR(facts.direction->pitch_deg.value(), -30.5, 1e-9);
  EXPECT_NEAR(facts.direction->roll_deg.value(), 0.25, 1e-9);
  EXPECT_FALSE(FactsOfXmp(Dji("1,234.5", "-30.00", "+0.00")).direction.has_value());
}

// The same angles, as the older aircraft write them: elements instead of attributes.
TEST(PictureFacts, ReadsXmpElements) {
  const PictureFacts facts = FactsOfXmp(
      "<x:xmpmeta xmlns:x=\"adobe:ns:meta/\"><rdf:RDF "
      "xmlns:rdf=\"http://www.w3.org/1999/02/22-rdf-syntax-ns#\"><rdf:Description "
      "xmlns:d=\"http://www.dji.com/drone-dji/1.0/\">\n<d:GimbalYawDegree> +12.5 "
      "</d:GimbalYawDegree><d:GimbalPitchDegree>-90.10</d:GimbalPitchDegree>"
      "</rdf:Description></rdf:RDF></x:xmpmeta>");
  // Past the vertical, the picture's top points backwards: the angles are put in range.
  EXPECT_NEAR(facts.direction->heading_deg, 192.5, 1e-6);
  EXPECT_NEAR(facts.direction->pitch_deg.value(), -89.9, 1e-6);
  EXPECT_NEAR(std::abs(facts.direction->roll_deg.value()), 180.0, 1e-6);
}

// Pix4D support, "How are yaw, pitch, roll defined?": its three examples, zero written as 360 once,
// since three zeros are taken as never written.
TEST(PictureFacts, ReadsPix4dsExamples) {
  const auto top_and_axis = [](const PictureFacts& facts) {
    const Eigen::Matrix3d world_from_cam = RotationOf(facts).toRotationMatrix().transpose();
    return std::pair<Eigen::Vector3d, Eigen::Vector3d>(-world_from_cam.col(1),
                                                       world_from_cam.col(2));
  };
  const Eigen::Vector3d north(0, 1, 0);
  const Eigen::Vector3d east(1, 0, 0);
  const Eigen::Vector3d up(0, 0, 1);
  const auto [top0, axis0] = top_and_axis(FactsOfXmp(Pix4d(360, 0, 0)));
  EXPECT_TRUE(top0.isApprox(north, 1e-9)) << top0.transpose();
  EXPECT_TRUE(axis0.isApprox(-up, 1e-9));
  const auto [top1, axis1] = top_and_axis(FactsOfXmp(Pix4d(0, 90, 0)));
  EXPECT_TRUE(top1.isApprox(up, 1e-9));
  EXPECT_TRUE(axis1.isApprox(north, 1e-9));
  const auto [top2, axis2] = top_and_axis(FactsOfXmp(Pix4d(90, 0, 0)));
  EXPECT_TRUE(top2.isApprox(east, 1e-9));
  EXPECT_TRUE(axis2.isApprox(-up, 1e-9));
}

TEST(PictureFacts, DjisPitchPlus90IsPix4ds) {
  for (const double pitch : {-80.0, -45.0, -30.0, -5.0}) {
    const PictureFacts dji = FactsOfXmp(Dji("+33.60", std::to_string(pitch), "+0.00"));
    const PictureFacts pix4d = FactsOfXmp(Pix4d(33.6, pitch + 90.0, 0.0));
    EXPECT_NEAR(RotationDistanceDeg(RotationOf(dji), RotationOf(pix4d)), 0.0, 1e-5) << pitch;
    // And omega of the photogrammetric angles, with the top to the north.
    const PictureFacts northward = FactsOfXmp(Dji("+0.00", std::to_string(pitch), "+0.00"));
    EXPECT_NEAR(OmegaPhiKappaOf(RotationOf(northward)).omega_deg, pitch + 90.0, 1e-9);
  }
}

TEST(PictureFacts, ReadsGooglesHeading) {
  const PictureFacts facts =
      FactsOfXmp(XmpPacket("xmlns:GPano=\"http://ns.google.com/photos/1.0/panorama/\" "
                           "GPano:PoseHeadingDegrees=\"350.5\" GPano:PosePitchDegrees=\"2\" "
                           "GPano:PoseRollDegrees=\"-1\""));
  EXPECT_NEAR(facts.direction->heading_deg, 350.5, 1e-9);
  EXPECT_NEAR(facts.direction->pitch_deg.value(), 2.0, 1e-9);
  EXPECT_NEAR(facts.direction->roll_deg.value(), -1.0, 1e-9);
}

TEST(PictureFacts, XmpGoesBeforeExif) {
  const PictureFacts facts =
      FactsOf(ParseExif(Phone().Block()), ParseXmp(Dji("+10.00", "+0.00", "+0.00")));
  EXPECT_EQ(facts.place->source, "DJI's XMP");
  EXPECT_NEAR(facts.direction->heading_deg, 10.0, 1e-9);
  EXPECT_FALSE(facts.direction->magnetic);
}

TEST(PictureFacts, BrokenXmpIsNoError) {
  const std::string whole = Dji("+10.00", "-20.00", "+0.00");
  for (std::size_t size = 0; size < whole.size(); size += 7) FactsOfXmp(whole.substr(0, size));
  EXPECT_FALSE(FactsOfXmp("not XML at all").direction.has_value());
  EXPECT_FALSE(FactsOfXmp(Dji("nan", "-20.00", "+0.00")).direction.has_value());
}

TEST(PictureCamera, FocalLengthByTheDiagonal) {
  PictureFacts facts;
  facts.focal_35mm = 26.0;
  // 4032 x 3024 has a diagonal of 5040 px; that of 36 x 24 mm is 43.2666 mm.
  const PictureCamera made = CameraOf(facts, 4032, 3024);
  EXPECT_NEAR(made.camera.params[0], 26.0 * 5040.0 / 43.26661531, 1e-4);
  EXPECT_EQ(made.camera.params[1], 2016.0);
  EXPECT_EQ(made.camera.params[2], 1512.0);
  EXPECT_FALSE(made.assumed);
}

TEST(PictureCamera, PortraitHasItsSidesExchanged) {
  PictureFacts facts;
  facts.focal_35mm = 26.0;
  const double landscape = CameraOf(facts, 4032, 3024).camera.params[0];
  for (int orientation = 1; orientation <= 8; ++orientation) {
    facts.orientation = orientation;
    const CameraIntrinsics camera = CameraOf(facts, 4032, 3024).camera;
    EXPECT_EQ(camera.width, orientation >= 5 ? 3024 : 4032) << orientation;
    EXPECT_EQ(camera.params[1], 0.5 * camera.width);
    EXPECT_DOUBLE_EQ(camera.params[0], landscape);
  }
}

TEST(PictureCamera, OtherSourcesOfTheFocalLength) {
  PictureFacts facts;
  EXPECT_TRUE(CameraOf(facts, 4000, 3000).assumed);
  // 8.8 mm on a sensor of 13.2 mm.
  facts.focal_mm = 8.8;
  facts.camera = "FC6310";
  EXPECT_NEAR(CameraOf(facts, 5472, 3648).camera.params[0], 5472.0 * 8.8 / 13.2, 1e-9);
  // Portrait by the sensor's longer side.
  EXPECT_NEAR(CameraOf(facts, 3648, 5472).camera.params[0], 5472.0 * 8.8 / 13.2, 1e-9);
  // The plane's resolution: 5472 px / 13.2 mm, the picture resized to a half.
  facts.plane_px_per_mm = 5472.0 / 13.2;
  facts.recorded = PictureFacts::Size{5472.0, 3648.0};
  facts.camera = "unknown";
  EXPECT_NEAR(CameraOf(facts, 2736, 1824).camera.params[0], 2736.0 * 8.8 / 13.2, 1e-9);
  facts.calibration = PictureFacts::Calibration{3666.666, std::nullopt};
  EXPECT_EQ(CameraOf(facts, 5472, 3648).camera.params[0], 3666.666);
}

// What each orientation does to the stored corner, from the EXIF standard's table: orientation 6
// has its first row on the right and its first column at the top.
TEST(TurnedUpright, PutsTheStoredRowsWhereTheStandardSays) {
  cv::Mat stored(2, 3, CV_8U);
  for (int i = 0; i < 6; ++i) stored.data[i] = static_cast<unsigned char>(i);
  // Stored row 0 is 0 1 2, row 1 is 3 4 5.
  const auto rows = [&](int orientation) {
    const cv::Mat shown = TurnedUpright(stored, orientation);
    std::string text;
    for (int r = 0; r < shown.rows; ++r) {
      for (int c = 0; c < shown.cols; ++c) text += static_cast<char>('0' + shown.at<uchar>(r, c));
      text += ' ';
    }
    return text;
  };
  EXPECT_EQ(rows(1), "012 345 ");
  EXPECT_EQ(rows(2), "210 543 ");
  EXPECT_EQ(rows(3), "543 210 ");
  EXPECT_EQ(rows(4), "345 012 ");
  EXPECT_EQ(rows(5), "03 14 25 ");
  EXPECT_EQ(rows(6), "30 41 52 ");
  EXPECT_EQ(rows(7), "52 41 30 ");
  EXPECT_EQ(rows(8), "25 14 03 ");
}

// A point of the scene above the axis lies where the turned picture has its top.
TEST(OrientationRoll, AgreesWithTurningThePicture) {
  for (const int orientation : {1, 3, 6, 8}) {
    const Eigen::Quaterniond rolled =
        CamFromWorld(ViewAngles{0.0, 0.0, OrientationRollDeg(orientation)});
    const Eigen::Vector3d above = rolled * Eigen::Vector3d(0.0, 1.0, 0.2);
    // Where it falls in a stored picture of 201 x 101 px, f = 100 px.
    const int column = static_cast<int>(100.5 + 100.0 * above.x() / above.z());
    const int row = static_cast<int>(50.5 + 100.0 * above.y() / above.z());
    cv::Mat stored = cv::Mat::zeros(101, 201, CV_8U);
    stored.at<uchar>(row, column) = 1;
    const cv::Mat shown = TurnedUpright(stored, orientation);
    cv::Mat places;
    cv::findNonZero(shown, places);
    EXPECT_NEAR(places.at<cv::Point>(0).x, shown.cols / 2, 1) << orientation;
    EXPECT_NEAR(places.at<cv::Point>(0).y, shown.rows / 2 - 20, 1) << orientation;
  }
}

}  // namespace
}  // namespace ridgeline
