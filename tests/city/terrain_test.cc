// SPDX-License-Identifier: Apache-2.0
#include "city/terrain.h"

#include <gdal_priv.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <ogr_spatialref.h>

#include <cmath>
#include <limits>
#include <string>

#include "base/error.h"
#include "base/random.h"
#include "city/city_text.h"

namespace ridgeline::testing {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

constexpr int kSize = 40;
constexpr double kNodata = -9999.0;

double Relief(double east, double north) {
  return 500.0 + 3.0 * std::sin(east / 7.0) + 0.1 * (north - 5336000.0);
}

struct RasterSpec {
  double west = 691000.0;
  double north = 5336040.0;
  double dx = 1.0;
  double dy = -1.0;
  double turn_x = 0.0;
  double turn_y = 0.0;
  int epsg = 25832;
};

// Writes a GeoTIFF of Relief with one cell unknown at column 5, row 5.
std::filesystem::path WriteRaster(const TestFolder& folder, const RasterSpec& spec) {
  GDALAllRegister();
  const std::filesystem::path file = folder.path() / "dtm.tif";
  GDALDriver* const driver = GetGDALDriverManager()->GetDriverByName("GTiff");
  GDALDataset* const dataset = driver->Create(file.c_str(), kSize, kSize, 1, GDT_Float32, nullptr);
  double transform[6] = {spec.west, spec.dx, spec.turn_x, spec.north, spec.turn_y, spec.dy};
  dataset->SetGeoTransform(transform);
  if (spec.epsg != 0) {
    OGRSpatialReference srs;
    srs.importFromEPSG(spec.epsg);
    dataset->SetSpatialRef(&srs);
  }
  GDALRasterBand* const band = dataset->GetRasterBand(1);
  band->SetNoDataValue(kNodata);
  for (int row = 0; row < kSize; ++row) {
    std::vector<float> values;
    for (int column = 0; column < kSize; ++column) {
      const double east = spec.west + (column + 0.5) * spec.dx + (row + 0.5) * spec.turn_x;
      const double north = spec.north + (column + 0.5) * spec.turn_y + (row + 0.5) * spec.dy;
      const bool unknown = row == 5 && column == 5;
      values.push_back(unknown ? static_cast<float>(kNodata)
                               : static_cast<float>(Relief(east, north)));
    }
    EXPECT_EQ(band->RasterIO(
                  GF_Write, 0, row, kSize, 1, values.data(), kSize, 1, GDT_Float32, 0, 0, nullptr),
              CE_None);
  }
  GDALClose(dataset);
  return file;
}

CityModel ModelAt(const Eigen::Vector3d& origin) {
  CityModel model;
  model.crs = {25832, 0};
  model.origin_in_world = origin;
  return model;
}

const Eigen::Vector3d kOrigin(691000.0, 5336000.0, 500.0);

HeightGrid ReadAll(const std::filesystem::path& file) {
  std::vector<std::string> warnings;
  return ReadDtm(file, ModelAt(kOrigin), {0, 0}, {40, 40}, 0.0, warnings);
}

std::string ErrorOf(const std::filesystem::path& file, const Eigen::Vector2d& lower) {
  std::vector<std::string> warnings;
  try {
    ReadDtm(file, ModelAt(kOrigin), lower, lower + Eigen::Vector2d(10, 10), 5.0, warnings);
  } catch (const InputError& e) {
    return e.what();
  }
  return {};
}

TEST(Dtm, CellCentresHaveTheirValues) {
  const TestFolder folder;
  const HeightGrid grid = ReadAll(WriteRaster(folder, {}));
  EXPECT_EQ(grid.columns, kSize);
  EXPECT_EQ(grid.rows, kSize);
  EXPECT_EQ(grid.first, Eigen::Vector2d(0.5, 0.5));
  for (const double x : {0.5, 10.5, 39.5}) {
    for (const double y : {0.5, 20.5, 39.5}) {
      const std::optional<double> height = grid.HeightAt({x, y});
      ASSERT_TRUE(height.has_value()) << x << " " << y;
      // Float cells at 500 m: steps of 3e-5 m.
      EXPECT_NEAR(*height, Relief(691000 + x, 5336000 + y) - 500.0, 1e-4);
    }
  }
}

TEST(Dtm, BilinearAgreesWithGdal) {
  const TestFolder folder;
  const std::filesystem::path file = WriteRaster(folder, {});
  const HeightGrid grid = ReadAll(file);
  GDALDataset* const dataset =
      GDALDataset::Open(file.c_str(), GDAL_OF_RASTER, nullptr, nullptr, nullptr);
  Random random(1, 1);
  for (int i = 0; i < 200; ++i) {
    const double x = random.Uniform(8.0, 39.0);
    const double y = random.Uniform(1.0, 39.0);
    // GDAL resamples a tiny window around the point bilinearly.
    GDALRasterIOExtraArg extra;
    INIT_RASTERIO_EXTRA_ARG(extra);
    extra.eResampleAlg = GRIORA_Bilinear;
    extra.bFloatingPointWindowValidity = TRUE;
    constexpr double kWindow = 1e-3;
    extra.dfXOff = x - 0.5 * kWindow;
    extra.dfYOff = kSize - y - 0.5 * kWindow;
    extra.dfXSize = kWindow;
    extra.dfYSize = kWindow;
    double expected = 0.0;
    ASSERT_EQ(dataset->GetRasterBand(1)->RasterIO(GF_Read,
                                                  static_cast<int>(x),
                                                  static_cast<int>(kSize - y),
                                                  1,
                                                  1,
                                                  &expected,
                                                  1,
                                                  1,
                                                  GDT_Float64,
                                                  0,
                                                  0,
                                                  &extra),
              CE_None);
    const std::optional<double> height = grid.HeightAt({x, y});
    ASSERT_TRUE(height.has_value());
    EXPECT_NEAR(*height, expected - 500.0, 2e-3) << x << " " << y;
  }
  GDALClose(dataset);
}

TEST(Dtm, UnknownBesideNodataAndOutside) {
  const TestFolder folder;
  const HeightGrid grid = ReadAll(WriteRaster(folder, {}));
  // The unknown cell's centre is at column 5, row 5 from the top: (5.5, 34.5).
  EXPECT_FALSE(grid.HeightAt({5.5, 34.5}).has_value());
  EXPECT_FALSE(grid.HeightAt({4.9, 34.9}).has_value());
  EXPECT_TRUE(grid.HeightAt({4.5, 34.5}).has_value());
  EXPECT_FALSE(grid.HeightAt({0.4, 10.0}).has_value());
  EXPECT_FALSE(grid.HeightAt({10.0, 39.6}).has_value());
  EXPECT_FALSE(grid.HeightAt({std::numeric_limits<double>::quiet_NaN(), 10.0}).has_value());
}

TEST(Dtm, OnlyTheBoxIsRead) {
  const TestFolder folder;
  std::vector<std::string> warnings;
  const HeightGrid grid =
      ReadDtm(WriteRaster(folder, {}), ModelAt(kOrigin), {10, 20}, {15, 25}, 2.0, warnings);
  EXPECT_LE(grid.columns, 12);
  EXPECT_GE(grid.columns, 9);
  ASSERT_TRUE(grid.HeightAt({8, 18}).has_value());
  ASSERT_TRUE(grid.HeightAt({17, 27}).has_value());
  EXPECT_NEAR(*grid.HeightAt({12.5, 22.5}), Relief(691012.5, 5336022.5) - 500.0, 1e-4);
}

TEST(Dtm, OblongCellsAreResampled) {
  const TestFolder folder;
  RasterSpec spec;
  spec.dx = 0.5;
  const std::filesystem::path file = WriteRaster(folder, spec);
  std::vector<std::string> warnings;
  const HeightGrid grid = ReadDtm(file, ModelAt(kOrigin), {5, 5}, {15, 35}, 0.0, warnings);
  ASSERT_TRUE(grid.HeightAt({10, 20}).has_value());
  EXPECT_NEAR(*grid.HeightAt({10, 20}), Relief(691010, 5336020) - 500.0, 0.02);
}

TEST(Dtm, WrongSystemIsRefused) {
  const TestFolder folder;
  RasterSpec spec;
  spec.epsg = 25833;
  EXPECT_THAT(
      ErrorOf(WriteRaster(folder, spec), {0, 0}),
      AllOf(HasSubstr("dtm.tif: CRS: got EPSG:25833, expected EPSG:25832"), HasSubstr("gdalwarp")));
}

TEST(Dtm, SameSystemUnderACompoundCodeIsTaken) {
  const TestFolder folder;
  RasterSpec spec;
  spec.epsg = 5555;  // ETRS89 / UTM 32N + DHHN92
  EXPECT_EQ(ErrorOf(WriteRaster(folder, spec), {0, 0}), "");
}

TEST(Dtm, MissingSystemIsAWarning) {
  const TestFolder folder;
  RasterSpec spec;
  spec.epsg = 0;
  std::vector<std::string> warnings;
  ReadDtm(WriteRaster(folder, spec), ModelAt(kOrigin), {0, 0}, {9, 9}, 0.0, warnings);
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_THAT(warnings[0], HasSubstr("names no reference system"));
}

TEST(Dtm, RasterElsewhereIsRefused) {
  const TestFolder folder;
  EXPECT_THAT(ErrorOf(WriteRaster(folder, {}), {5000, 0}),
              AllOf(HasSubstr("extent: got 691000..691040 E"), HasSubstr("terrain at 695995..")));
}

TEST(Dtm, UnreadableFile) {
  const TestFolder folder;
  EXPECT_THAT(ErrorOf(folder.Write("dtm.tif", "no raster"), {0, 0}),
              HasSubstr("a file that GDAL cannot open as a raster"));
  EXPECT_THAT(ErrorOf("/nowhere/dtm.tif", {0, 0}), HasSubstr("/nowhere/dtm.tif"));
}

}  // namespace
}  // namespace ridgeline::testing
