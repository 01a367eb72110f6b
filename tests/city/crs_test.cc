// SPDX-License-Identifier: Apache-2.0
#include "city/crs.h"

#include <gtest/gtest.h>
#include <ogr_spatialref.h>

#include <string>

#include "base/error.h"

namespace ridgeline {
namespace {

struct Spelling {
  const char* name;
  int horizontal;
  int vertical;
};

class CrsSpellings : public ::testing::TestWithParam<Spelling> {};

TEST_P(CrsSpellings, IsUnderstood) {
  const std::optional<Crs> crs = ParseCrs(GetParam().name);
  ASSERT_TRUE(crs.has_value());
  EXPECT_EQ(crs->horizontal_epsg, GetParam().horizontal);
  EXPECT_EQ(crs->vertical_epsg, GetParam().vertical);
}

INSTANTIATE_TEST_SUITE_P(
    AsFoundInFiles,
    CrsSpellings,
    ::testing::Values(Spelling{"EPSG:25832", 25832, 0},
                      Spelling{" EPSG:31468 ", 31468, 0},
                      Spelling{"25833", 25833, 0},
                      Spelling{"urn:ogc:def:crs:EPSG::28992", 28992, 0},
                      Spelling{"urn:ogc:def:crs:EPSG:6.12:31467", 31467, 0},
                      Spelling{"urn:ogc:def:crs,crs:EPSG::25832,crs:EPSG::5783", 25832, 5783},
                      Spelling{"urn:ogc:def:crs,crs:EPSG:6.12:3068,crs:EPSG:6.12:5783", 3068, 5783},
                      Spelling{"http://www.opengis.net/def/crs/EPSG/0/25832", 25832, 0},
                      Spelling{"https://www.opengis.net/def/crs/EPSG/0/28992", 28992, 0},
                      Spelling{"http://www.opengis.net/gml/srs/epsg.xml#31256", 31256, 0},
                      Spelling{"http://www.opengis.net/def/crs/EPSG/0/6697", 6668, 6695},
                      Spelling{"urn:ogc:def:crs:EPSG::7415", 28992, 5709},
                      Spelling{"EPSG:7415", 28992, 5709},
                      Spelling{"EPSG:25832+7837", 25832, 7837},
                      Spelling{"EPSG:5555", 25832, 5783},
                      Spelling{"urn:adv:crs:ETRS89_UTM32*DE_DHHN2016_NH", 25832, 7837},
                      Spelling{"urn:adv:crs:ETRS89_UTM32*DE_DHHN2016_NH*GCG2016", 25832, 7837},
                      Spelling{"urn:adv:crs:ETRS89_UTM32*DE_DHHN92_NH", 25832, 5783},
                      Spelling{"urn:adv:crs:ETRS89_UTM33", 25833, 0},
                      Spelling{"urn:adv:crs:DE_DHDN_3GK4*DE_DHHN92_NH", 31468, 5783},
                      Spelling{"ETRS89_UTM32*DE_DHHN2016_NH", 25832, 7837},
                      Spelling{"http://www.opengis.net/def/crs-compound?"
                               "1=http://www.opengis.net/def/crs/EPSG/0/25832&"
                               "2=http://www.opengis.net/def/crs/EPSG/0/7837",
                               25832,
                               7837}));

std::string WktOf(const OGRSpatialReference& srs) {
  char* text = nullptr;
  srs.exportToWkt(&text);
  const std::string wkt = text;
  CPLFree(text);
  return wkt;
}

TEST(Crs, WktIsUnderstood) {
  OGRSpatialReference compound;
  compound.SetFromUserInput("EPSG:25832+7837");
  const std::optional<Crs> parts = ParseCrs(WktOf(compound));
  ASSERT_TRUE(parts.has_value());
  EXPECT_EQ(parts->horizontal_epsg, 25832);
  EXPECT_EQ(parts->vertical_epsg, 7837);
  OGRSpatialReference promoted;
  promoted.importFromEPSG(25832);
  promoted.PromoteTo3D(nullptr);
  const std::optional<Crs> flat = ParseCrs(WktOf(promoted));
  ASSERT_TRUE(flat.has_value());
  EXPECT_EQ(flat->horizontal_epsg, 25832);
  // As ESRI and older programs write it: without a code.
  const std::optional<Crs> bare = ParseCrs(
      R"(PROJCS["ETRS89 / UTM zone 32N",GEOGCS["ETRS89",DATUM["European_Terrestrial_Reference_System_)"
      R"(1989",SPHEROID["GRS 1980",6378137,298.257222101]],PRIMEM["Greenwich",0],UNIT["degree",)"
      R"(0.0174532925199433]],PROJECTION["Transverse_Mercator"],PARAMETER["latitude_of_origin",0],)"
      R"(PARAMETER["central_meridian",9],PARAMETER["scale_factor",0.9996],PARAMETER["false_easting",)"
      R"(500000],PARAMETER["false_northing",0],UNIT["metre",1]])");
  ASSERT_TRUE(bare.has_value());
  EXPECT_EQ(bare->horizontal_epsg, 25832);
}

TEST(Crs, NonsenseIsNotUnderstood) {
  for (const char* name :
       {"", "UTM32", "urn:adv:crs:MARS", "EPSG:", "EPSG:25832+", "unknown", "EPSG:12", "x25832"}) {
    EXPECT_FALSE(ParseCrs(name).has_value()) << name;
  }
}

TEST(Crs, NamesReadBack) {
  EXPECT_EQ(CrsName({25832, 7837}), "EPSG:25832+7837");
  EXPECT_EQ(CrsName({25832, 0}), "EPSG:25832");
  EXPECT_EQ(CrsName({}), "no CRS");
}

TEST(ToProjected, KeepsEastNorthOfProjectedFiles) {
  const Eigen::Vector3d munich(691000, 5336000, 515);
  const ToProjected same({25832, 0}, {}, munich, "f");
  EXPECT_FALSE(same.swaps());
  EXPECT_FALSE(same.transforms());
  // EPSG lists Gauss-Kruger as northing, easting; files have them east first.
  const ToProjected kruger({31468, 0}, {}, {4468000, 5335000, 515}, "f");
  EXPECT_FALSE(kruger.swaps());
}

TEST(ToProjected, SwapsWhereOnlyTheOtherOrderFits) {
  const ToProjected swapped({25832, 0}, {}, {5336000, 691000, 515}, "f");
  EXPECT_TRUE(swapped.swaps());
  std::vector<Eigen::Vector3d> points{{5336000, 691000, 515}};
  swapped.Apply(points);
  EXPECT_EQ(points[0], Eigen::Vector3d(691000, 5336000, 515));
}

TEST(ToProjected, GeographicGoesToItsUtmZone) {
  // Tokyo station in PLATEAU's order: latitude, longitude, height.
  const Eigen::Vector3d tokyo(35.681236, 139.767125, 3.0);
  const ToProjected projection({6668, 6695}, {}, tokyo, "f");
  EXPECT_EQ(projection.crs().horizontal_epsg, 6691);
  EXPECT_EQ(projection.crs().vertical_epsg, 6695);
  std::vector<Eigen::Vector3d> points{tokyo};
  projection.Apply(points);
  // UTM 54N of the place by an independent formula (Krueger's series, third order).
  EXPECT_NEAR(points[0].x(), 388435.687, 0.01);
  EXPECT_NEAR(points[0].y(), 3949293.978, 0.01);
  EXPECT_EQ(points[0].z(), 3.0);
  // And back to where it was.
  const auto back = LatitudeLongitude(projection.crs(), points[0].head<2>());
  ASSERT_TRUE(back.has_value());
  EXPECT_NEAR(back->x(), tokyo.x(), 1e-6);
  EXPECT_NEAR(back->y(), tokyo.y(), 1e-6);
}

TEST(ToProjected, GoesToTheSystemAskedFor) {
  const ToProjected projection({6668, 0}, {6677, 0}, {35.681236, 139.767125, 3.0}, "f");
  EXPECT_EQ(projection.crs().horizontal_epsg, 6677);
  EXPECT_THROW(ToProjected({6668, 0}, {4326, 0}, {35.6, 139.7, 3.0}, "f"), InputError);
}

// By Krueger's series (fourth order) on GRS 80, worked out apart from PROJ.
TEST(EastNorth, AgreesWithKruegersSeries) {
  const auto place = EastNorth({25832, 0}, 48.148912, 11.567891);
  ASSERT_TRUE(place.has_value());
  EXPECT_NEAR(place->x(), 690994.268718, 1e-3);
  EXPECT_NEAR(place->y(), 5336040.500417, 1e-3);
  EXPECT_FALSE(EastNorth({4326, 0}, 48.0, 11.0).has_value());
  EXPECT_FALSE(EastNorth({0, 0}, 48.0, 11.0).has_value());
}

TEST(MeridianConvergence, AgreesWithKruegersSeriesOnBothSides) {
  EXPECT_NEAR(*MeridianConvergenceDeg({25832, 0}, {690994.2687, 5336040.5004}), 1.9133495, 1e-5);
  EXPECT_NEAR(*MeridianConvergenceDeg({25832, 0}, {440495.7468, 5333160.8369}), -0.5959225, 1e-5);
  EXPECT_NEAR(*MeridianConvergenceDeg({25832, 0}, {500000.0, 5333160.0}), 0.0, 1e-6);
  EXPECT_FALSE(MeridianConvergenceDeg({0, 0}, {500000.0, 5333160.0}).has_value());
}

}  // namespace
}  // namespace ridgeline
