// SPDX-License-Identifier: Apache-2.0
// Rasters as other programs write them, read as terrain.
#include <gdal_priv.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <ogr_spatialref.h>
#include <sys/stat.h>

#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "base/error.h"
#include "base/gdal_handles.h"
#include "city/city_info.h"
#include "city/city_text.h"
#include "city/crs.h"
#include "city/terrain.h"

namespace ridgeline::testing {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

constexpr int kSize = 20;
constexpr double kFoot = 0.3048;
constexpr double kUsFoot = 1200.0 / 3937.0;
const Eigen::Vector3d kWest(691000.0, 5336000.0, 0.0);

struct Spec {
  GDALDataType type = GDT_Float32;
  int bands = 1;
  const char* system = "EPSG:25832";
  double dx = 1.0;
  double unit_m = 1.0;  // heights are written in it
  double hole = -9999.0;
  const char* option = nullptr;
};

double Height(double east, double north) {
  return 110.0 + 0.2 * (east - kWest.x()) + 0.1 * (north - kWest.y());
}

bool InHole(int column, int row) { return column >= 8 && column < 12 && row >= 8 && row < 12; }

// Terrain of Height with a hole in the middle; `change` sees the open file.
std::filesystem::path Write(const TestFolder& folder,
                            const Spec& spec,
                            const std::function<void(GDALDataset&)>& change = {}) {
  GDALAllRegister();
  CPLSetConfigOption("GDAL_TIFF_INTERNAL_MASK", "YES");
  const std::filesystem::path file = folder.path() / "dtm.tif";
  const char* options[] = {spec.option, nullptr};
  const GdalDatasetPtr dataset(GetGDALDriverManager()->GetDriverByName("GTiff")->Create(
      file.c_str(), kSize, kSize, spec.bands, spec.type, const_cast<char**>(options)));
  double transform[6] = {kWest.x(), spec.dx, 0.0, kWest.y() + kSize, 0.0, -1.0};
  dataset->SetGeoTransform(transform);
  OGRSpatialReference srs;
  if (spec.system != nullptr && srs.SetFromUserInput(spec.system) == OGRERR_NONE) {
    dataset->SetSpatialRef(&srs);
  }
  if (change) change(*dataset);
  for (int row = 0; row < kSize; ++row) {
    std::vector<double> values;
    for (int column = 0; column < kSize; ++column) {
      const double east = kWest.x() + (column + 0.5) * spec.dx;
      const double north = kWest.y() + kSize - row - 0.5;
      values.push_back(InHole(column, row) ? spec.hole : Height(east, north) / spec.unit_m);
    }
    for (int b = 1; b <= spec.bands; ++b) {
      EXPECT_EQ(
          dataset->GetRasterBand(b)->RasterIO(
              GF_Write, 0, row, kSize, 1, values.data(), kSize, 1, GDT_Float64, 0, 0, nullptr),
          CE_None);
    }
  }
  return file;
}

// 0 in the hole, 255 elsewhere.
void WriteMask(GDALRasterBand& band) {
  for (int row = 0; row < kSize; ++row) {
    std::vector<unsigned char> values;
    for (int column = 0; column < kSize; ++column) values.push_back(InHole(column, row) ? 0 : 255);
    EXPECT_EQ(
        band.RasterIO(GF_Write, 0, row, kSize, 1, values.data(), kSize, 1, GDT_Byte, 0, 0, nullptr),
        CE_None);
  }
}

struct Terrain {
  HeightGrid grid;
  std::vector<std::string> warnings;
};

Terrain Read(const std::filesystem::path& file, double width = kSize) {
  CityModel model;
  model.crs = {25832, 0};
  model.origin_in_world = kWest;
  Terrain terrain;
  terrain.grid = ReadDtm(file, model, {0, 0}, {width, kSize}, 0.0, terrain.warnings);
  return terrain;
}

std::string ErrorOf(const std::filesystem::path& file) {
  try {
    Read(file);
  } catch (const InputError& e) {
    return e.what();
  }
  return {};
}

void ExpectTerrainWithHole(const HeightGrid& grid, double dx = 1.0) {
  for (const double x : {2.5, 5.5, 16.5}) {
    const std::optional<double> height = grid.HeightAt({x * dx, 4.5});
    ASSERT_TRUE(height.has_value()) << x;
    EXPECT_NEAR(*height, Height(kWest.x() + x * dx, kWest.y() + 4.5), 0.02) << x;
  }
  for (const double x : {8.5, 10.0, 11.5}) {
    EXPECT_FALSE(grid.HeightAt({x * dx, 10.0}).has_value()) << x;
  }
  // Nothing of the hole's value bleeds into its neighbours.
  for (const float height : grid.heights) {
    if (!std::isnan(height)) {
      ASSERT_GT(height, 105.0f);
    }
  }
}

TEST(RasterMissing, DeclaredByNodata) {
  const TestFolder folder;
  const Terrain terrain =
      Read(Write(folder, {}, [](GDALDataset& d) { d.GetRasterBand(1)->SetNoDataValue(-9999.0); }));
  ExpectTerrainWithHole(terrain.grid);
  EXPECT_THAT(terrain.warnings, IsEmpty());
}

TEST(RasterMissing, MarkedByAMask) {
  const TestFolder folder;
  Spec spec;
  spec.hole = 0.0;
  const auto file = Write(folder, spec, [](GDALDataset& d) {
    ASSERT_EQ(d.CreateMaskBand(GMF_PER_DATASET), CE_None);
    WriteMask(*d.GetRasterBand(1)->GetMaskBand());
  });
  ExpectTerrainWithHole(Read(file).grid);
}

TEST(RasterMissing, MarkedByAlpha) {
  const TestFolder folder;
  Spec spec;
  spec.hole = 0.0;
  spec.bands = 2;
  spec.type = GDT_UInt16;
  spec.option = "ALPHA=YES";
  const auto file = Write(folder, spec);
  {
    const GdalDatasetPtr dataset(GDALDataset::Open(file.c_str(), GDAL_OF_RASTER | GDAL_OF_UPDATE));
    for (int row = 0; row < kSize; ++row) {
      std::vector<unsigned short> values;
      for (int column = 0; column < kSize; ++column) {
        values.push_back(InHole(column, row) ? 0 : 65535);
      }
      EXPECT_EQ(dataset->GetRasterBand(2)->RasterIO(
                    GF_Write, 0, row, kSize, 1, values.data(), kSize, 1, GDT_UInt16, 0, 0, nullptr),
                CE_None);
    }
  }
  // Whole metres.
  const HeightGrid grid = Read(file).grid;
  EXPECT_FALSE(grid.HeightAt({10.0, 10.0}).has_value());
  ASSERT_TRUE(grid.HeightAt({2.5, 4.5}).has_value());
  EXPECT_NEAR(*grid.HeightAt({2.5, 4.5}), Height(kWest.x() + 2.5, kWest.y() + 4.5), 1.0);
}

TEST(RasterMissing, FillThatNobodyDeclaredIsAWarning) {
  for (const double fill : {-9999.0, -32768.0, -3.4028234663852886e38, 3.4e38, 1e6}) {
    const TestFolder folder;
    Spec spec;
    spec.hole = fill;
    const Terrain terrain = Read(Write(folder, spec));
    ExpectTerrainWithHole(terrain.grid);
    EXPECT_THAT(terrain.warnings, Contains(HasSubstr("16 cells hold"))) << fill;
  }
}

TEST(RasterMissing, ZerosFarBelowAllOthersAreAWarning) {
  const TestFolder folder;
  Spec spec;
  spec.hole = 0.0;
  EXPECT_THAT(Read(Write(folder, spec)).warnings,
              Contains(HasSubstr("16 cells are at 0 m, all others above 110")));
  spec.unit_m = 1000.0;  // a shore of 0.11 m and more
  EXPECT_THAT(Read(Write(folder, spec)).warnings, IsEmpty());
}

TEST(RasterMissing, FillOfSmallUnitsIsNoHeight) {
  const TestFolder folder;
  Spec spec;
  spec.type = GDT_Int16;
  spec.unit_m = 0.01;
  spec.hole = -9999.0;  // would be -99.99 m
  const Terrain terrain =
      Read(Write(folder, spec, [](GDALDataset& d) { d.GetRasterBand(1)->SetUnitType("cm"); }));
  ExpectTerrainWithHole(terrain.grid);
}

TEST(RasterMissing, IsNotResampledIntoItsNeighbours) {
  for (const bool masked : {false, true}) {
    const TestFolder folder;
    Spec spec;
    spec.dx = 0.5;  // oblong cells
    spec.hole = masked ? 0.0 : -9999.0;
    const auto file = Write(folder, spec, [&](GDALDataset& d) {
      if (!masked) return;
      ASSERT_EQ(d.CreateMaskBand(GMF_PER_DATASET), CE_None);
      WriteMask(*d.GetRasterBand(1)->GetMaskBand());
    });
    ExpectTerrainWithHole(Read(file, 10.0).grid, 0.5);
  }
}

TEST(RasterUnit, OfTheBand) {
  struct Unit {
    const char* name;
    double metres;
  };
  for (const Unit& unit : {Unit{"ft", kFoot},
                           Unit{"US survey foot", kUsFoot},
                           Unit{"cm", 0.01},
                           Unit{"dm", 0.1},
                           Unit{"m", 1.0}}) {
    const TestFolder folder;
    Spec spec;
    spec.unit_m = unit.metres;
    const Terrain terrain = Read(
        Write(folder, spec, [&](GDALDataset& d) { d.GetRasterBand(1)->SetUnitType(unit.name); }));
    ExpectTerrainWithHole(terrain.grid);
    const std::string said = std::string("heights in the unit ") + unit.name;
    if (unit.metres != 1.0) {
      EXPECT_THAT(terrain.warnings, Contains(HasSubstr(said)));
    }
  }
}

TEST(RasterUnit, OfTheVerticalSystem) {
  const TestFolder folder;
  Spec spec;
  spec.system = "EPSG:25832+6360";
  spec.unit_m = kUsFoot;
  ExpectTerrainWithHole(Read(Write(folder, spec)).grid);
}

TEST(RasterUnit, ThatIsNoLengthIsRefused) {
  const TestFolder folder;
  EXPECT_THAT(
      ErrorOf(Write(folder, {}, [](GDALDataset& d) { d.GetRasterBand(1)->SetUnitType("K"); })),
      HasSubstr("unit: got \"K\""));
}

// A plane in a state plane system of feet, read beside a model in metres at the same place.
TEST(RasterUnit, WholeRastersInFeetAreMoved) {
  const TestFolder folder;
  GDALAllRegister();
  const std::filesystem::path file = folder.path() / "feet.tif";
  {
    const GdalDatasetPtr dataset(GetGDALDriverManager()->GetDriverByName("GTiff")->Create(
        file.c_str(), 200, 200, 1, GDT_Float32, nullptr));
    double transform[6] = {984000.0, 3.0, 0.0, 199600.0, 0.0, -3.0};
    dataset->SetGeoTransform(transform);
    OGRSpatialReference srs;
    srs.importFromEPSG(2263);
    dataset->SetSpatialRef(&srs);
    std::vector<float> values(200 * 200, 328.0f);
    ASSERT_EQ(dataset->GetRasterBand(1)->RasterIO(
                  GF_Write, 0, 0, 200, 200, values.data(), 200, 200, GDT_Float32, 0, 0, nullptr),
              CE_None);
  }
  const ToProjected move({2263, 0}, {}, {984300.0, 199300.0, 0.0}, "f");
  std::vector<Eigen::Vector3d> middle = {{984300.0, 199300.0, 0.0}};
  move.Apply(middle);
  CityModel model;
  model.crs = move.crs();
  model.origin_in_world = middle[0];
  std::vector<std::string> warnings;
  const HeightGrid grid = ReadDtm(file, model, {-10, -10}, {10, 10}, 5.0, warnings);
  ASSERT_TRUE(grid.HeightAt({0, 0}).has_value());
  EXPECT_NEAR(*grid.HeightAt({0, 0}), 328.0 * kUsFoot, 1e-3);
  EXPECT_NEAR(grid.spacing_m, 3.0 * kUsFoot, 1e-3);
  EXPECT_THAT(warnings, Contains(HasSubstr("heights in the unit US survey foot")));
}

TEST(RasterSystem, PromotedToThreeDimensionsIsTheSame) {
  const TestFolder folder;
  OGRSpatialReference srs;
  srs.importFromEPSG(25832);
  srs.PromoteTo3D(nullptr);
  Spec spec;
  spec.system = nullptr;
  ExpectTerrainWithHole(
      Read(Write(folder, spec, [&](GDALDataset& d) { d.SetSpatialRef(&srs); })).grid);
}

TEST(RasterKind, PicturesAreNoTerrain) {
  const TestFolder folder;
  Spec colour;
  colour.type = GDT_Byte;
  colour.bands = 3;
  colour.option = "PHOTOMETRIC=RGB";
  EXPECT_THAT(ErrorOf(Write(folder, colour)), HasSubstr("a colour picture (band 1 is Red)"));
  Spec palette;
  palette.type = GDT_Byte;
  EXPECT_THAT(ErrorOf(Write(folder,
                            palette,
                            [](GDALDataset& d) {
                              GDALColorTable table;
                              const GDALColorEntry green{0, 200, 0, 255};
                              table.SetColorEntry(1, &green);
                              d.GetRasterBand(1)->SetColorTable(&table);
                            })),
              HasSubstr("colours of a palette"));
  Spec grey;
  grey.type = GDT_Byte;
  EXPECT_THAT(ErrorOf(Write(folder, grey)), HasSubstr("a picture of 8 bits"));
  Spec complex;
  complex.type = GDT_CFloat32;
  EXPECT_THAT(ErrorOf(Write(folder, complex)), HasSubstr("complex numbers (CFloat32)"));
  Spec several;
  several.bands = 4;
  EXPECT_THAT(ErrorOf(Write(folder, several)), HasSubstr("a raster of 4 bands"));
}

TEST(RasterKind, PipesAreNotWaitedFor) {
  const TestFolder folder;
  const std::filesystem::path pipe = folder.path() / "dtm.tif";
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  EXPECT_THAT(ErrorOf(pipe), HasSubstr("dtm.tif: got a pipe or a device"));
  EXPECT_THROW(DescribeRaster(pipe), InputError);
  EXPECT_THROW(DescribeRaster("/dev/zero"), InputError);
}

// GDAL opens what a VRT names, at any depth.
TEST(RasterKind, APipeBehindAVrtIsNoTerrain) {
  const TestFolder folder;
  const std::filesystem::path pipe = folder.path() / "pipe.tif";
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  const auto vrt = [](const std::string& source) {
    return "<VRTDataset rasterXSize=\"9\" rasterYSize=\"9\"><VRTRasterBand dataType=\"Float32\" "
           "band=\"1\"><SimpleSource><SourceFilename relativeToVRT=\"1\">" +
           source + "</SourceFilename></SimpleSource></VRTRasterBand></VRTDataset>";
  };
  EXPECT_THAT(ErrorOf(folder.Write("direct.vrt", vrt("pipe.tif"))),
              HasSubstr("direct.vrt: SourceFilename: got the pipe or device"));
  EXPECT_THAT(ErrorOf(folder.Write("behind.vrt", vrt("direct.vrt"))),
              HasSubstr("behind.vrt: SourceFilename: got the pipe or device"));
  EXPECT_THAT(ErrorOf(folder.Write("letters.vrt", vrt("p&#105;pe.tif"))),
              HasSubstr("got the pipe or device"));
  // One that names itself ends, too.
  EXPECT_NE(ErrorOf(folder.Write("circle.vrt", vrt("circle.vrt"))), "");
}

// Names that GDAL would take for servers, data bases and documents of its own.
TEST(RasterKind, NamesThatAreNoFilesAreNotOpened) {
  for (const char* name : {"PG:host=127.0.0.1",
                           "/vsicurl/http://127.0.0.1:1/a.tif",
                           "/vsizip//vsicurl/http://127.0.0.1:1/a.zip/a.tif",
                           "/vsistdin/",
                           "WMS:http://127.0.0.1:1/",
                           "<VRTDataset rasterXSize=\"5\" rasterYSize=\"5\"></VRTDataset>"}) {
    EXPECT_THAT(ErrorOf(name), HasSubstr("got a name that is no file on this machine")) << name;
  }
  EXPECT_THAT(ErrorOf("/vsizip/no.zip/a.tif"), HasSubstr("got no such file in the archive"));
}

// GDAL's drivers of map servers would ask the server that such a file names.
TEST(RasterKind, DescriptionsOfMapServersAreNotOpened) {
  const TestFolder folder;
  const auto file = folder.Write(
      "wms.xml",
      "<GDAL_WMS><Service name=\"TMS\"><ServerUrl>http://127.0.0.1:1/${z}/${x}/${y}.tif</ServerUrl>"
      "</Service><DataWindow><UpperLeftX>691000</UpperLeftX><UpperLeftY>5336020</UpperLeftY>"
      "<LowerRightX>691020</LowerRightX><LowerRightY>5336000</LowerRightY><SizeX>20</SizeX>"
      "<SizeY>20</SizeY></DataWindow><Projection>EPSG:25832</Projection><BandsCount>1</BandsCount>"
      "<DataType>Float32</DataType></GDAL_WMS>");
  EXPECT_THAT(ErrorOf(file), HasSubstr("a file that GDAL cannot open as a raster"));
}

TEST(RasterKind, CellsOfNoSizeAreRefused) {
  for (const std::array<double, 6>& transform :
       {std::array<double, 6>{691000, 0, 0, 5336020, 0, 0},
        std::array<double, 6>{691000, 2, 2, 5336020, 2, 2},
        std::array<double, 6>{691000, std::nan(""), 0, 5336020, 0, -1},
        std::array<double, 6>{691000, 1e300, 0, 5336020, 0, -1e300}}) {
    const TestFolder folder;
    const auto file = Write(folder, {}, [&](GDALDataset& d) {
      std::array<double, 6> copy = transform;
      d.SetGeoTransform(copy.data());
    });
    EXPECT_THAT(ErrorOf(file), HasSubstr("dtm.tif: geotransform: got "));
    EXPECT_THROW(DescribeRaster(file), InputError);
  }
}

TEST(RasterKind, AScaleThatMakesAllHeightsEqualIsRefused) {
  const TestFolder folder;
  EXPECT_THAT(ErrorOf(Write(folder, {}, [](GDALDataset& d) { d.GetRasterBand(1)->SetScale(0.0); })),
              HasSubstr("dtm.tif: scale: got heights of 0 * cell + 0"));
}

TEST(RasterKind, InfoSaysSo) {
  const TestFolder folder;
  Spec several;
  several.bands = 4;
  EXPECT_THAT(DescribeRaster(Write(folder, several)).warnings,
              Contains(HasSubstr("no terrain model")));
}

// 100 000 x 100 000 cells in a file of a few kilobytes.
TEST(RasterLimit, HugeRastersAreReadNearThePlaceOnly) {
  const TestFolder folder;
  GDALAllRegister();
  const std::filesystem::path file = folder.path() / "huge.tif";
  {
    const char* options[] = {"SPARSE_OK=TRUE", "TILED=YES", "COMPRESS=DEFLATE", nullptr};
    const GdalDatasetPtr dataset(GetGDALDriverManager()->GetDriverByName("GTiff")->Create(
        file.c_str(), 100000, 100000, 1, GDT_Float32, const_cast<char**>(options)));
    double transform[6] = {kWest.x(), 1.0, 0.0, kWest.y() + 50000.0, 0.0, -1.0};
    dataset->SetGeoTransform(transform);
    OGRSpatialReference srs;
    srs.importFromEPSG(25832);
    dataset->SetSpatialRef(&srs);
  }
  EXPECT_LE(Read(file).grid.columns, kSize + 2);
  CityModel model;
  model.crs = {25832, 0};
  model.origin_in_world = kWest;
  std::vector<std::string> warnings;
  try {
    ReadDtm(file, model, {0, 0}, {90000, 40000}, 0.0, warnings);
    FAIL();
  } catch (const InputError& e) {
    EXPECT_THAT(e.what(), HasSubstr("huge.tif: limit: got 90"));
  }
}

TEST(RasterLimit, InfoReadsAPartOfHugeRasters) {
  const TestFolder folder;
  const auto vrt = [&](const std::string& size) {
    return folder.Write("a.vrt",
                        "<VRTDataset rasterXSize=\"" + size + "\" rasterYSize=\"" + size +
                            "\"><GeoTransform>691000, 1, 0, 5336000, 0, -1</GeoTransform>"
                            "<VRTRasterBand dataType=\"Float32\" band=\"1\"/></VRTDataset>");
  };
  EXPECT_GT(DescribeRaster(vrt("100000")).row_step, 1000);
  EXPECT_THROW(DescribeRaster(vrt("2000000000")), InputError);
}

// For one cell GDAL would unpack 270 million.
TEST(RasterLimit, BlocksThatAreTooLargeAreRefused) {
  const TestFolder folder;
  GDALAllRegister();
  const std::filesystem::path file = folder.path() / "blocks.tif";
  {
    const char* options[] = {
        "SPARSE_OK=TRUE", "TILED=YES", "BLOCKXSIZE=16384", "BLOCKYSIZE=16384", nullptr};
    const GdalDatasetPtr dataset(GetGDALDriverManager()->GetDriverByName("GTiff")->Create(
        file.c_str(), 20000, 20000, 1, GDT_Float32, const_cast<char**>(options)));
  }
  EXPECT_THAT(ErrorOf(file), HasSubstr("blocks.tif: limit: got cells in blocks of 16384 x 16384"));
  EXPECT_THROW(DescribeRaster(file), InputError);
}

// 10^8 cells of 1 m x 1 mm would become as many of 3 cm, held several times.
TEST(RasterLimit, GridsThatAreTurnedAreBoundedByWhatComesOut) {
  const TestFolder folder;
  const auto vrt = [&](const std::string& name, const std::string& transform) {
    return folder.Write(name,
                        "<VRTDataset rasterXSize=\"1000\" rasterYSize=\"100000\"><GeoTransform>" +
                            transform +
                            "</GeoTransform><VRTRasterBand dataType=\"Float32\" band=\"1\"/>"
                            "</VRTDataset>");
  };
  CityModel model;
  model.crs = {25832, 0};
  model.origin_in_world = {654000.0, 5412000.0, 400.0};
  const std::filesystem::path file = vrt("long.vrt", "653500, 1, 0, 5412050, 0, -0.001");
  std::vector<std::string> warnings;
  try {
    ReadDtm(file, model, {-450.0, -45.0}, {450.0, 45.0}, 0.0, warnings);
    FAIL();
  } catch (const InputError& e) {
    EXPECT_THAT(e.what(), HasSubstr("long.vrt: limit: got "));
    EXPECT_THAT(e.what(), HasSubstr("a grid that is not square and north up"));
  }
}

}  // namespace
}  // namespace ridgeline::testing
