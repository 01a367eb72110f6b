// SPDX-License-Identifier: Apache-2.0
#include "report/map_files.h"

#include <gdal_priv.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>
#include <ogrsf_frmts.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <memory>

#include "base/atomic_file.h"
#include "base/error.h"
#include "report/example_report.h"
#include "report/map_shapes.h"

namespace ridgeline {
namespace {

namespace fs = std::filesystem;

struct CloseDataset {
  void operator()(GDALDataset* dataset) const { GDALClose(dataset); }
};
using DatasetPtr = std::unique_ptr<GDALDataset, CloseDataset>;

DatasetPtr Open(const fs::path& path) { return DatasetPtr(GDALDataset::Open(path.c_str())); }

fs::path Temp(const std::string& name) { return fs::path(::testing::TempDir()) / (std::to_string(::getpid()) + name); }

TEST(WriteMap, GeoPackageHasALayerPerKindInTheModelsSystem) {
  const ReportData data = testing::ExampleReport(6);
  const fs::path path = Temp("map test ü.gpkg");
  WriteMap(data.runs, 25832, path);
  const DatasetPtr dataset = Open(path);
  ASSERT_TRUE(dataset);
  EXPECT_EQ(dataset->GetLayerCount(), 5);
  OGRLayer* poses = dataset->GetLayerByName("poses");
  ASSERT_NE(poses, nullptr);
  EXPECT_EQ(poses->GetFeatureCount(), 18);
  EXPECT_STREQ(poses->GetSpatialRef()->GetAuthorityCode(nullptr), "25832");
  OGREnvelope extent;
  ASSERT_EQ(poses->GetExtent(&extent), OGRERR_NONE);
  EXPECT_GT(extent.MinX, 690870.0);
  EXPECT_LT(extent.MaxX, 690920.0);
  EXPECT_GT(extent.MinY, 5335920.0);
  const std::unique_ptr<OGRFeature> first(poses->GetNextFeature());
  EXPECT_EQ(data.runs[0].id, first->GetFieldAsString("query"));
}

// RFC 7946: web maps take nothing else.
TEST(WriteMap, GeoJsonIsInWgs84) {
  const fs::path path = Temp("map.geojson");
  WriteMap(testing::ExampleReport(2).runs, 25832, path);
  const DatasetPtr dataset = Open(path);
  ASSERT_TRUE(dataset);
  EXPECT_STREQ(dataset->GetLayer(0)->GetSpatialRef()->GetAuthorityCode(nullptr), "4326");
  OGREnvelope extent;
  ASSERT_EQ(dataset->GetLayer(0)->GetExtent(&extent), OGRERR_NONE);
  EXPECT_NEAR(extent.MinX, 11.568, 0.01);
  EXPECT_NEAR(extent.MinY, 48.148, 0.01);
  EXPECT_EQ(ReadFile(path).find("\"crs\""), std::string::npos);
  EXPECT_GT(dataset->GetLayer(0)->GetFeatureCount(), 10);
}

TEST(WriteMap, KmlIsInDegrees) {
  const fs::path path = Temp("map.kml");
  WriteMap(testing::ExampleReport(2).runs, 25832, path);
  const DatasetPtr dataset = Open(path);
  ASSERT_TRUE(dataset);
  OGREnvelope extent;
  ASSERT_EQ(dataset->GetLayer(0)->GetExtent(&extent), OGRERR_NONE);
  // Gabelsbergerstrasse, Munich.
  EXPECT_NEAR(extent.MinX, 11.568, 0.01);
  EXPECT_NEAR(extent.MinY, 48.148, 0.01);
}

TEST(WriteMap, KmlNeedsASystem) {
  EXPECT_THROW(WriteMap(testing::ExampleReport(1).runs, 0, Temp("no.kml")), InputError);
  EXPECT_FALSE(fs::exists(Temp("no.kml")));
}

TEST(WriteMap, RefusesOtherExtensions) {
  try {
    WriteMap({}, 25832, Temp("map.shp"));
    FAIL();
  } catch (const InputError& e) {
    EXPECT_THAT(e.what(), ::testing::HasSubstr(".gpkg, .geojson or .kml"));
  }
}

TEST(WriteEnergyMap, PixelCentresAreThePositions) {
  ReportEnergyMap map;
  map.first = {690886.0, 5335930.0};
  map.spacing_m = 0.5;
  map.columns = 3;
  map.rows = 2;
  map.energies = {0.1f, 0.2f, 0.3f, 0.4f, 0.5f, std::nanf("")};
  const fs::path path = Temp("energy.tif");
  WriteEnergyMap(map, 25832, path);
  const DatasetPtr dataset = Open(path);
  ASSERT_TRUE(dataset);
  std::array<double, 6> transform{};
  dataset->GetGeoTransform(transform.data());
  EXPECT_DOUBLE_EQ(transform[0], 690885.75);
  EXPECT_DOUBLE_EQ(transform[3], 5335930.75);
  EXPECT_STREQ(dataset->GetSpatialRef()->GetAuthorityCode(nullptr), "25832");
  std::array<float, 6> values{};
  ASSERT_EQ(dataset->GetRasterBand(1)->RasterIO(
                GF_Read, 0, 0, 3, 2, values.data(), 3, 2, GDT_Float32, 0, 0),
            CE_None);
  EXPECT_FLOAT_EQ(values[3], 0.1f);  // lower left
  EXPECT_FLOAT_EQ(values[0], 0.4f);
  EXPECT_TRUE(std::isnan(values[2]));
}

TEST(EllipseOutline, HasTheAxesOfTheCovariance) {
  const Eigen::Matrix2d covariance{{4.0, 0.0}, {0.0, 1.0}};
  double reach = 0.0;
  for (const Eigen::Vector2d& p : EllipseOutline({10.0, 20.0}, covariance)) {
    reach = std::max(reach, std::abs(p.x() - 10.0));
  }
  EXPECT_NEAR(reach, 2.0 * 2.4477, 1e-3);  // sqrt of chi-square 0.95 with two degrees of freedom
}

TEST(ViewCone, OpensAroundTheHeading) {
  ReportPose pose;
  pose.heading_deg = 90.0;
  const auto cone = ViewCone(pose, 60.0, 10.0);
  EXPECT_NEAR(cone[7].x(), 10.0, 1e-9);  // the middle of the arc, due east
  EXPECT_NEAR(cone[7].y(), 0.0, 1e-9);
  EXPECT_NEAR(cone[1].y(), 5.0, 1e-9);  // 30 degrees to the left
  EXPECT_EQ(cone.front(), cone.back());
}

}  // namespace
}  // namespace ridgeline
