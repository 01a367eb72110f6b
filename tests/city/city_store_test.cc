// SPDX-License-Identifier: Apache-2.0
#include "city/store/city_store.h"

#include <gdal_priv.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <ogrsf_frmts.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <fstream>
#include <functional>
#include <set>

#include "base/error.h"
#include "city/city_text.h"

namespace ridgeline::testing {
namespace {

using ::testing::AllOf;
using ::testing::Contains;
using ::testing::HasSubstr;

namespace fs = std::filesystem;

// A row of four houses, tile by tile 100 m to the east; the last house of a tile is a tower of
// parts.
std::string TileText(int tile) {
  const auto name = [tile](int i) { return "t" + std::to_string(tile) + "_" + std::to_string(i); };
  const auto low = [tile](int i) {
    return Eigen::Vector3d(kCorner + Eigen::Vector3d(100.0 * tile + 20.0 * i, 0, 0));
  };
  std::string members;
  for (int i = 0; i < 3; ++i) {
    members += GmlBox(name(i), low(i), low(i) + Eigen::Vector3d(10, 10, 5));
  }
  const std::string part = GmlBox("", low(3), low(3) + Eigen::Vector3d(10, 10, 50));
  const std::size_t begin = part.find("<bldg:boundedBy>");
  const std::string content = part.substr(begin, part.rfind("</bldg:Building>") - begin);
  members +=
      GmlBuilding(name(3),
                  "<bldg:consistsOfBuildingPart><bldg:BuildingPart gml:id=\"" + name(3) + "_p\">" +
                      content + "</bldg:BuildingPart></bldg:consistsOfBuildingPart>");
  return GmlDocument(members, "EPSG:25832+7837");
}

struct Town {
  TestFolder folder;
  std::vector<fs::path> tiles;
  fs::path store = folder.path() / "city.gpkg";

  explicit Town(int count) {
    for (int t = 0; t < count; ++t) {
      tiles.push_back(folder.Write("tile" + std::to_string(t) + ".gml", TileText(t)));
    }
  }
};

std::string ErrorOf(const std::function<void()>& body) {
  try {
    body();
  } catch (const InputError& e) {
    return e.what();
  }
  return {};
}

std::set<std::string> Ids(const CityModel& model) {
  std::set<std::string> ids;
  for (const Building& building : model.buildings) ids.insert(building.id);
  return ids;
}

CityRegion RegionAt(double east_offset) {
  CityRegion region;
  const Eigen::Vector2d p = kCorner.head<2>() + Eigen::Vector2d(east_offset, -5.0);
  region.positions.extend(p);
  region.min_reach_m = 30.0;
  region.reach_per_height = 8.0;  // houses within 40 m, towers within 400 m
  region.max_reach_m = 400.0;
  return region;
}

TEST(CityStore, HoldsWhatItsTilesHold) {
  const Town town(3);
  const CityStoreResult result = WriteCityStore(town.tiles, town.store, {});
  EXPECT_EQ(result.tiles, 3u);
  EXPECT_EQ(result.buildings, 12u);
  const CityModel direct = ReadCity(town.tiles, {});
  const CityModel stored = ReadCity({town.store}, {});
  EXPECT_EQ(stored.crs.horizontal_epsg, 25832);
  EXPECT_EQ(stored.crs.vertical_epsg, 7837);
  EXPECT_EQ(stored.origin_in_world, direct.origin_in_world);
  EXPECT_EQ(stored.vertices, direct.vertices);
  EXPECT_EQ(Ids(stored), Ids(direct));
  ASSERT_EQ(stored.surfaces.size(), direct.surfaces.size());
  EXPECT_EQ(stored.feature_edges.size(), direct.feature_edges.size());
  EXPECT_NEAR(Volume(stored), Volume(direct), 1e-6);
  const auto part = std::find_if(stored.buildings.begin(),
                                 stored.buildings.end(),
                                 [](const Building& b) { return b.id == "t1_3_p"; });
  ASSERT_NE(part, stored.buildings.end());
  EXPECT_EQ(part->parent_id, "t1_3");
}

TEST(CityStore, RegionLoadsWhatCanBeSeen) {
  const Town town(4);
  WriteCityStore(town.tiles, town.store, {});
  CityOptions options;
  options.region = RegionAt(0.0);
  // By hand: houses at 0 and 20 m are within 40 m, at 40 m are not more than 40 m away; the towers
  // stand at 60, 160, 260 and 360 m.
  const std::set<std::string> expected{
      "t0_0", "t0_1", "t0_2", "t0_3_p", "t1_3_p", "t2_3_p", "t3_3_p"};
  std::set<std::string> found = Ids(ReadCity({town.store}, options));
  found.erase("t0_2");  // 40.3 m away: on the edge
  std::set<std::string> certain = expected;
  certain.erase("t0_2");
  EXPECT_EQ(found, certain);
  // Plain files are cut to the same region.
  EXPECT_EQ(Ids(ReadCity({town.store}, options)), Ids(ReadCity(town.tiles, options)));
}

TEST(CityStore, GoesOnAfterAnInterruption) {
  const Town town(4);
  const std::string good = TileText(2);
  town.folder.Write("tile2.gml", good.substr(0, good.size() / 2));
  CityOptions options;
  options.threads = 1;
  EXPECT_THAT(ErrorOf([&] { WriteCityStore(town.tiles, town.store, options); }),
              HasSubstr("a file that ends early"));
  EXPECT_FALSE(fs::exists(town.store));
  ASSERT_TRUE(fs::exists(town.folder.path() / "city.part.gpkg"));
  EXPECT_THAT(ErrorOf([&] { ReadCity({town.folder.path() / "city.part.gpkg"}, {}); }),
              HasSubstr("an unfinished store"));
  town.folder.Write("tile2.gml", good);
  const CityStoreResult result = WriteCityStore(town.tiles, town.store, options);
  EXPECT_EQ(result.tiles_before, 2u);
  EXPECT_EQ(result.tiles, 2u);
  EXPECT_EQ(result.buildings, 16u);
  EXPECT_FALSE(fs::exists(town.folder.path() / "city.part.gpkg"));
  EXPECT_EQ(Ids(ReadCity({town.store}, {})), Ids(ReadCity(town.tiles, {})));
}

TEST(CityStore, OtherSettingsBeginAnew) {
  const Town town(3);
  town.folder.Write("tile2.gml", "no model");
  CityOptions options;
  options.threads = 1;
  EXPECT_NE(ErrorOf([&] { WriteCityStore(town.tiles, town.store, options); }), "");
  town.folder.Write("tile2.gml", TileText(2));
  options.height_offset_m = 10.0;
  const CityStoreResult result = WriteCityStore(town.tiles, town.store, options);
  EXPECT_EQ(result.tiles_before, 0u);
  EXPECT_EQ(result.tiles, 3u);
}

TEST(CityStore, BuildingsInTwoTilesAreTakenOnce) {
  const Town town(2);
  const fs::path again = town.folder.Write("tile9.gml", TileText(1));
  const CityStoreResult result =
      WriteCityStore({town.tiles[0], town.tiles[1], again}, town.store, {});
  EXPECT_EQ(result.buildings, 8u);
  EXPECT_THAT(result.warnings,
              Contains(HasSubstr("4 buildings that an earlier file holds too, taken once")));
}

TEST(CityStore, IsAGeoPackageForEveryone) {
  const Town town(1);
  WriteCityStore(town.tiles, town.store, {});
  GDALAllRegister();
  GDALDataset* const dataset = GDALDataset::Open(town.store.c_str(), GDAL_OF_VECTOR);
  ASSERT_NE(dataset, nullptr);
  OGRLayer* const layer = dataset->GetLayerByName("buildings");
  ASSERT_NE(layer, nullptr);
  EXPECT_EQ(layer->GetFeatureCount(), 4);
  EXPECT_TRUE(layer->TestCapability(OLCFastSpatialFilter));
  const OGRFeatureUniquePtr feature(layer->GetNextFeature());
  EXPECT_NEAR(feature->GetGeometryRef()->toMultiPolygon()->get_Area(), 100.0, 1e-6);
  EXPECT_NEAR(feature->GetFieldAsDouble("height_m"), 5.0, 1e-9);
  GDALClose(dataset);
}

TEST(CityStore, OtherFilesAreRefused) {
  const Town town(1);
  EXPECT_THAT(ErrorOf([&] { ReadCity({town.folder.Write("x.gpkg", "not a database")}, {}); }),
              HasSubstr("cannot be opened as a GeoPackage"));
  EXPECT_THAT(ErrorOf([&] { WriteCityStore(town.tiles, town.folder.path() / "city.db", {}); }),
              HasSubstr("a name without .gpkg"));
  const fs::path bad = town.folder.Write("bad.gml", "no model");
  EXPECT_NE(ErrorOf([&] { WriteCityStore({bad}, town.store, {}); }), "");
  EXPECT_FALSE(fs::exists(town.folder.path() / "city.part.gpkg"));
  EXPECT_THAT(ErrorOf([&] { WriteCityStore(town.tiles, "/nowhere/city.gpkg", {}); }),
              HasSubstr("a folder that cannot be written"));
  WriteCityStore(town.tiles, town.store, {});
  const std::string half = [&] {
    std::string bytes(fs::file_size(town.store) / 2, '\0');
    std::ifstream(town.store, std::ios::binary)
        .read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    return bytes;
  }();
  EXPECT_NE(ErrorOf([&] { ReadCity({town.folder.Write("half.gpkg", half)}, {}); }), "");
}

TEST(CityStore, DamagedSurfacesAreNamed) {
  const Town town(1);
  WriteCityStore(town.tiles, town.store, {});
  GDALDataset* const dataset =
      GDALDataset::Open(town.store.c_str(), GDAL_OF_VECTOR | GDAL_OF_UPDATE);
  OGRLayer* const layer = dataset->GetLayerByName("buildings");
  const OGRFeatureUniquePtr feature(layer->GetFeature(2));
  const unsigned char bytes[] = {1, 0, 0, 0, 2, 0, 0, 0, 255, 255, 255, 255};
  feature->SetField(feature->GetFieldIndex("surfaces"), 12, bytes);
  EXPECT_EQ(layer->SetFeature(feature.get()), OGRERR_NONE);
  GDALClose(dataset);
  EXPECT_THAT(ErrorOf([&] { ReadCity({town.store}, {}); }),
              AllOf(HasSubstr("t0_1"), HasSubstr("damaged surfaces")));
}

TEST(CityStore, TilesOfTwoSystemsNeedATarget) {
  const Town town(1);
  std::string other = TileText(5);
  other.replace(other.find("EPSG:25832"), 10, "EPSG:25833");
  const fs::path tile = town.folder.Write("other.gml", other);
  // The same numbers, moved to zone 32, lie 380 km farther east.
  const CityStoreResult result = WriteCityStore({town.tiles[0], tile}, town.store, {});
  EXPECT_EQ(result.buildings, 8u);
  CityOptions options;
  options.region = RegionAt(0.0);
  EXPECT_FALSE(Ids(ReadCity({town.store}, options)).contains("t5_0"));
}

}  // namespace
}  // namespace ridgeline::testing
