// SPDX-License-Identifier: Apache-2.0
#include "city/units.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <string>

#include "base/error.h"
#include "city/city_text.h"
#include "city/crs.h"
#include "city/read_city.h"

namespace ridgeline::testing {
namespace {

using ::testing::AllOf;
using ::testing::Contains;
using ::testing::HasSubstr;

constexpr double kFoot = 0.3048;
constexpr double kUsFoot = 1200.0 / 3937.0;

TEST(Units, NamesAsFilesWriteThem) {
  const auto expect = [](const char* name, double metres) {
    const std::optional<double> found = MetresPerUnit(name);
    ASSERT_TRUE(found.has_value()) << name;
    EXPECT_DOUBLE_EQ(*found, metres) << name;
  };
  for (const char* name : {"m", "metre", "Meters", "urn:ogc:def:uom:EPSG::9001"}) expect(name, 1.0);
  for (const char* name :
       {"ft", "foot", "FEET", "International foot", "urn:ogc:def:uom:EPSG::9002"})
    expect(name, kFoot);
  for (const char* name : {"US survey foot", "us-ft", "ftUS", "US_survey_feet", "#9003", "Foot_US"})
    expect(name, kUsFoot);
  expect("cm", 0.01);
  expect("decimetres", 0.1);
  expect("mm", 0.001);
  expect("km", 1000.0);
  for (const char* name : {"", "kelvin", "degree", "counts"}) {
    EXPECT_FALSE(MetresPerUnit(name).has_value()) << name;
  }
}

// Figures of the EPSG register.
TEST(Units, OfSystems) {
  EXPECT_NEAR(HorizontalUnit({2263, 0}).metres, kUsFoot, 1e-12);
  EXPECT_TRUE(HorizontalUnit({25832, 0}).IsMetre());
  EXPECT_TRUE(HorizontalUnit({4326, 0}).IsMetre());
  EXPECT_NEAR(HeightUnit({25832, 6360}).metres, kUsFoot, 1e-12);
  EXPECT_NEAR(HeightUnit({25832, 8228}).metres, kFoot, 1e-12);
  EXPECT_NEAR(HeightUnit({2263, 0}).metres, kUsFoot, 1e-12);
  EXPECT_TRUE(HeightUnit({2263, 5703}).IsMetre());
  EXPECT_EQ(VerticalEpsgInMetres(6360), 5703);
  EXPECT_EQ(VerticalEpsgInMetres(7837), 7837);
}

const Eigen::Vector3d kNewYork(984280.0, 199280.0, 20.0);  // US survey feet

TEST(FeetModel, BecomesMetres) {
  const Eigen::Vector3d size(40.0, 40.0, 30.0);
  const CityModel model = ReadGml(GmlDocument(GmlBox("a", kNewYork, kNewYork + size), "EPSG:2263"));
  EXPECT_EQ(model.crs.horizontal_epsg, 26918);
  // The scale of UTM 18 N is 0.9998 here, that of the state plane 1.0000.
  EXPECT_NEAR(Area(model, SurfaceClass::kWall), 4.0 * 40.0 * 30.0 * kUsFoot * kUsFoot, 0.2);
  EXPECT_NEAR(Volume(model), size.prod() * std::pow(kUsFoot, 3.0), 1.0);
  double lowest = 1e9;
  for (const Eigen::Vector3d& v : model.vertices) {
    lowest = std::min(lowest, v.z() + model.origin_in_world.z());
  }
  EXPECT_NEAR(lowest, 20.0 * kUsFoot, 1e-6);
  EXPECT_THAT(model.warnings, Contains(HasSubstr("heights in the unit US survey foot")));
  EXPECT_THAT(model.warnings, Contains(HasSubstr("moved to EPSG:26918")));
}

TEST(FeetModel, ProjectedElsewhereHasItsHeightsInMetresToo) {
  CityOptions options;
  options.project_to = "EPSG:32618";
  const CityModel model = ReadGml(
      GmlDocument(GmlBox("a", kNewYork, kNewYork + Eigen::Vector3d(40, 40, 30)), "EPSG:2263"),
      options);
  EXPECT_EQ(model.crs.horizontal_epsg, 32618);
  EXPECT_NEAR(Area(model, SurfaceClass::kWall), 4800.0 * kUsFoot * kUsFoot, 0.2);
}

TEST(FeetModel, HeightsMayBeMetresAlready) {
  const CityModel model = ReadGml(
      GmlDocument(GmlBox("a", kNewYork, kNewYork + Eigen::Vector3d(40, 40, 30)), "EPSG:2263+5703"));
  // A UTM zone is true to scale within four parts in 10 000.
  const double area = 4.0 * 40.0 * kUsFoot * 30.0;
  EXPECT_NEAR(Area(model, SurfaceClass::kWall), area, 4e-4 * area);
  EXPECT_EQ(model.crs.vertical_epsg, 5703);
}

TEST(FeetModel, HeightsAloneMayBeFeet) {
  const CityModel model = ReadGml(
      GmlDocument(GmlBox("a", kCorner, kCorner + Eigen::Vector3d(10, 8, 6)), "EPSG:25832+8228"));
  EXPECT_NEAR(Volume(model), 480.0 * kFoot, 1e-3);
  EXPECT_EQ(model.crs.vertical_epsg, 5703);
}

TEST(FeetModel, LabelsOfAxesCount) {
  std::string text =
      GmlDocument(GmlBox("a", kCorner, kCorner + Eigen::Vector3d(10, 8, 6)), "EPSG:25832");
  text.replace(text.find("<gml:Envelope"), 13, "<gml:Envelope uomLabels=\"m m ft\"");
  const CityModel model = ReadGml(text);
  EXPECT_NEAR(Volume(model), 480.0 * kFoot, 1e-3);
  EXPECT_THAT(model.warnings, Contains(HasSubstr("uomLabels")));
}

std::string ErrorOf(const std::string& text, const CityOptions& options = {}) {
  try {
    ReadGml(text, options);
  } catch (const InputError& e) {
    return e.what();
  }
  return {};
}

TEST(MapSystem, FeetAreNoTarget) {
  CityOptions options;
  options.project_to = "EPSG:2263";
  EXPECT_THAT(ErrorOf(GmlDocument(GmlBox("a", kNewYork, kNewYork + Eigen::Vector3d(40, 40, 30)),
                                  "EPSG:2263"),
                      options),
              AllOf(HasSubstr("project_to: got EPSG:2263, whose unit is the US survey foot"),
                    HasSubstr("EPSG:26918")));
}

// Scale of the Mercator projection: 1 / cos(latitude) on the sphere; on the ellipsoid the
// meridian's is larger by the ratio of the radii.
TEST(MapSystem, WebMercatorIsRefusedWithItsScale) {
  const double radius = 6378137.0;
  const double latitude = 40.7 * M_PI / 180.0;
  const Eigen::Vector3d corner(
      -74.0 * M_PI / 180.0 * radius, radius * std::log(std::tan(M_PI / 4 + latitude / 2)), 10.0);
  const std::optional<CrsFit> fit = FitAt({3857, 0}, corner.head<2>());
  ASSERT_TRUE(fit.has_value());
  EXPECT_NEAR(fit->scale_east, 1.0 / std::cos(latitude), 0.002);
  EXPECT_FALSE(fit->IsTrueToScale());
  const std::string text =
      GmlDocument(GmlBox("a", corner, corner + Eigen::Vector3d(12, 12, 9)), "EPSG:3857");
  EXPECT_THAT(
      ErrorOf(text),
      AllOf(HasSubstr("EPSG:3857, whose metres are 1.317"), HasSubstr("--project-to EPSG:32618")));
  CityOptions options;
  options.project_to = "EPSG:32618";
  const CityModel model = ReadGml(text, options);
  EXPECT_NEAR(Area(model, SurfaceClass::kWall), 4 * 12 * 9 * std::cos(latitude), 1.0);
}

TEST(MapSystem, OrdinarySystemsAreTrueToScale) {
  struct Place {
    int epsg;
    double east, north;
  };
  for (const Place& p : {Place{25832, 691000, 5336000},
                         Place{31468, 4468000, 5335000},
                         Place{2056, 2600000, 1200000},
                         Place{27700, 530000, 180000},
                         Place{28992, 121000, 487000},
                         Place{2154, 652000, 6862000},
                         Place{6677, -6000, -35000}}) {
    const std::optional<CrsFit> fit = FitAt({p.epsg, 0}, {p.east, p.north});
    ASSERT_TRUE(fit.has_value()) << p.epsg;
    EXPECT_TRUE(fit->IsTrueToScale())
        << p.epsg << " " << fit->scale_north << " " << fit->scale_east;
    EXPECT_EQ(fit->outside_deg, 0.0) << p.epsg;
  }
}

TEST(MapSystem, ModelsFarOutsideOfTheirAreaAreDoubted) {
  const Eigen::Vector3d far(500000.0, 1000000.0, 0.0);  // 9 N, where 25832 begins at 38.76 N
  const CityModel model =
      ReadGml(GmlDocument(GmlBox("a", far, far + Eigen::Vector3d(10, 8, 6)), "EPSG:25832"));
  EXPECT_THAT(model.warnings,
              Contains(HasSubstr("30 degrees outside of where EPSG:25832 is used")));
}

TEST(EastNorthReach, PlacesFarOutsideHaveNone) {
  EXPECT_FALSE(EastNorth({25832, 0}, 24.7, 121.0).has_value());
  EXPECT_FALSE(EastNorth({25832, 0}, 44.98, -93.27).has_value());
  EXPECT_FALSE(EastNorth({25832, 0}, -33.9, 9.0).has_value());
  EXPECT_TRUE(EastNorth({25832, 0}, 52.5, 13.4).has_value());    // Berlin, a zone farther
  EXPECT_TRUE(EastNorth({2193, 0}, -43.9, -176.5).has_value());  // across the date line
}

}  // namespace
}  // namespace ridgeline::testing
