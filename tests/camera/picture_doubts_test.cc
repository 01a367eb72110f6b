// SPDX-License-Identifier: Apache-2.0
// Items of EXIF and XMP that are absent or odd: what is assumed is said.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "camera/picture_facts.h"
#include "support/exif_writer.h"
#include "support/xmp_writer.h"

namespace ridgeline {
namespace {

using testing::ExifWriter;
using testing::XmpPacket;
using Directory = testing::ExifWriter::Directory;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

PictureFacts FactsOfExif(const ExifWriter& exif) { return FactsOf(ParseExif(exif.Block()), {}); }
PictureFacts FactsOfXmp(const std::string& attributes, const std::string& elements = "") {
  return FactsOf({}, ParseXmp(XmpPacket(attributes, elements)));
}

ExifWriter Place() {
  ExifWriter exif;
  exif.Text(Directory::kGps, 1, "N")
      .Ratios(Directory::kGps, 2, {{49, 1}, {0, 1}, {0, 1}})
      .Text(Directory::kGps, 3, "E")
      .Ratios(Directory::kGps, 4, {{8, 1}, {24, 1}, {0, 1}});
  return exif;
}

TEST(PictureDoubts, APlainPlaceHasNone) { EXPECT_THAT(FactsOfExif(Place()).doubts, IsEmpty()); }

TEST(PictureDoubts, HemispheresThatAreAbsentOrOdd) {
  const auto place = [](const char* longitude_reference) {
    ExifWriter exif;
    exif.Text(Directory::kGps, 1, "n")
        .Ratios(Directory::kGps, 2, {{49, 1}})
        .Ratios(Directory::kGps, 4, {{42, 5}});
    if (longitude_reference != nullptr) exif.Text(Directory::kGps, 3, longitude_reference);
    return FactsOfExif(exif);
  };
  EXPECT_EQ(place(nullptr).place->longitude_deg, 8.4);
  EXPECT_THAT(place(nullptr).doubts,
              Contains(HasSubstr("hemisphere is not told (EXIF GPSLongitudeRef); east assumed")));
  EXPECT_EQ(place("west").place->longitude_deg, -8.4);
  EXPECT_THAT(place("west").doubts, IsEmpty());
  EXPECT_EQ(place("x").place->longitude_deg, 8.4);
  EXPECT_THAT(place("x").doubts, Contains(HasSubstr("no letter that is known")));
}

TEST(PictureDoubts, DatumsThatAreNotWgs84) {
  const auto doubts = [](const char* datum) {
    return FactsOfExif(Place().Text(Directory::kGps, 18, datum)).doubts;
  };
  EXPECT_THAT(doubts("TOKYO"), Contains(HasSubstr("names the datum TOKYO; taken as WGS 84")));
  EXPECT_THAT(doubts("NAD27"), Contains(HasSubstr("hundreds of metres")));
  for (const char* same : {"WGS-84", "WGS84", "WGS-84   ", "EGM-96", "", "wgs 84", "ETRS89"}) {
    EXPECT_THAT(doubts(same), IsEmpty()) << same;
  }
}

TEST(PictureDoubts, ReceiversErrors) {
  EXPECT_EQ(FactsOfExif(Place().Ratios(Directory::kGps, 31, {{47, 10}})).horizontal_error_m, 4.7);
  const PictureFacts dop = FactsOfExif(Place().Ratios(Directory::kGps, 11, {{36, 10}}));
  EXPECT_EQ(dop.horizontal_error_m, 18.0);
  EXPECT_THAT(dop.doubts, Contains(HasSubstr("GPSDOP 3.6 is taken as an error of 18 m")));
  EXPECT_THAT(FactsOfExif(Place().Text(Directory::kGps, 9, "V")).doubts,
              Contains(HasSubstr("no valid fix")));
  const PictureFacts network =
      FactsOfExif(Place().Undefined(Directory::kGps, 27, std::string("ASCII\0\0\0CELLID", 14)));
  EXPECT_EQ(network.horizontal_error_m, 100.0);
  EXPECT_THAT(network.doubts, Contains(HasSubstr("from the network")));
}

TEST(PictureDoubts, AltitudesAndTheirReference) {
  ExifWriter plain = Place();
  plain.Ratios(Directory::kGps, 6, {{230, 1}});
  const PictureFacts bare = FactsOfExif(plain);
  EXPECT_EQ(bare.altitude_m, 230.0);
  EXPECT_THAT(bare.doubts, Contains(HasSubstr("reference is not told")));
  EXPECT_THAT(FactsOfExif(ExifWriter(plain).Byte(Directory::kGps, 5, 0)).doubts, IsEmpty());
  EXPECT_EQ(FactsOfExif(ExifWriter(plain).Text(Directory::kGps, 5, "1")).altitude_m, -230.0);
  EXPECT_TRUE(FactsOfExif(ExifWriter(plain).Byte(Directory::kGps, 5, 2)).altitude_above_ellipsoid);
  const PictureFacts flat = FactsOfExif(ExifWriter(plain).Text(Directory::kGps, 10, "2"));
  EXPECT_FALSE(flat.altitude_m.has_value());
  EXPECT_THAT(flat.doubts, Contains(HasSubstr("two-dimensional")));
  ExifWriter zero;
  zero.Byte(Directory::kGps, 5, 0).Ratios(Directory::kGps, 6, {{0, 1}});
  EXPECT_FALSE(FactsOfExif(zero).altitude_m.has_value());
  EXPECT_THAT(FactsOfExif(zero).doubts, Contains(HasSubstr("never written")));
}

TEST(PictureDoubts, HeadingsAndTheirNorth) {
  ExifWriter plain;
  plain.Ratios(Directory::kGps, 17, {{1123, 10}});
  EXPECT_FALSE(FactsOfExif(plain).direction->magnetic);
  EXPECT_THAT(FactsOfExif(plain).doubts, Contains(HasSubstr("true north assumed")));
  ExifWriter absurd;
  absurd.Text(Directory::kGps, 16, "T").Ratios(Directory::kGps, 17, {{4000000000U, 1}});
  EXPECT_FALSE(FactsOfExif(absurd).direction.has_value());
  EXPECT_THAT(FactsOfExif(absurd).doubts, Contains(HasSubstr("is no direction")));
}

TEST(PictureFacts, AircraftByMakerAndByXmp) {
  for (const char* make : {"DJI", "Autel Robotics", "Parrot", "Skydio", "senseFly", "SENTERA"}) {
    EXPECT_TRUE(FactsOfExif(ExifWriter().Text(Directory::kImage, 0x010f, make)).from_aircraft);
  }
  for (const char* make : {"Apple", "samsung", "Canon", "Google", "Hasselblad"}) {
    EXPECT_FALSE(FactsOfExif(ExifWriter().Text(Directory::kImage, 0x010f, make)).from_aircraft);
  }
}

TEST(PictureFacts, HeightsOfAircraft) {
  const PictureFacts pix4d = FactsOfXmp(
      "xmlns:Camera=\"http://pix4d.com/camera/1.0\" Camera:AboveGroundAltitude=\"120.5\" "
      "Camera:GPSXYAccuracy=\"1.5\"");
  EXPECT_EQ(pix4d.height_above_ground_m, 120.5);
  EXPECT_EQ(pix4d.horizontal_error_m, 1.5);
  EXPECT_TRUE(pix4d.from_aircraft);
  const PictureFacts skydio = FactsOfXmp(
      "xmlns:s=\"https://www.skydio.com/drone-skydio/1.0/\" s:RelativeAltitude=\"25.0\" "
      "s:AbsoluteAltitude=\"230.5\" s:Latitude=\"49\" s:Longitude=\"8.4\" "
      "s:GpsHorizontalAccuracy=\"0.8\"",
      "<s:CalibratedFocalLength s:X=\"3100\" s:Y=\"3101\"/><s:CalibratedOpticalCenter s:X=\"2028\" "
      "s:Y=\"1520\"/>");
  EXPECT_EQ(skydio.altitude_above_takeoff_m, 25.0);
  EXPECT_EQ(skydio.altitude_m, 230.5);
  EXPECT_TRUE(skydio.altitude_above_ellipsoid);
  EXPECT_EQ(skydio.place->source, "Skydio's XMP");
  EXPECT_EQ(skydio.horizontal_error_m, 0.8);
  EXPECT_EQ(skydio.calibration->focal, 3100.0);
  EXPECT_EQ(skydio.calibration->size->width_px, 4056.0);
  const PictureFacts rtk = FactsOfXmp(
      "xmlns:d=\"http://www.dji.com/drone-dji/1.0/\" d:AbsoluteAltitude=\"+280.10\" "
      "d:AltitudeType=\"RtkAlt\" d:RelativeAltitude=\"+1e300\"");
  EXPECT_TRUE(rtk.altitude_above_ellipsoid);
  EXPECT_FALSE(rtk.altitude_above_takeoff_m.has_value());
}

}  // namespace
}  // namespace ridgeline
