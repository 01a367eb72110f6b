// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <set>
#include <string>

#include "city/city_info.h"
#include "city/city_text.h"
#include "city/read_city.h"
#include "city/xml_count.h"
#include "support/source_folder.h"

namespace ridgeline::testing {
namespace {

namespace fs = std::filesystem;

const fs::path kData = fs::path(kSourceFolder) / "../shared/data";

std::vector<fs::path> CityGmlFiles() {
  std::vector<fs::path> files;
  for (const char* folder : {"citygml", "munich", "ingolstadt"}) {
    std::error_code error;
    for (const fs::directory_entry& entry :
         fs::recursive_directory_iterator(kData / folder, error)) {
      const std::string extension = entry.path().extension().string();
      if (extension == ".gml" || extension == ".citygml") files.push_back(entry.path());
    }
  }
  std::sort(files.begin(), files.end());
  return files;
}

std::size_t Dropped(const CityInfo& info) {
  static const std::set<std::string> kinds = {
      "polygons without area dropped",
      "polygons given twice dropped",
      "polygons with fewer than 3 points dropped",
      "polygons without coordinates dropped",
      "polygons without heights (coordinates in pairs) dropped"};
  std::size_t count = 0;
  for (const auto& [kind, entry] : info.dropped.entries()) {
    if (kinds.contains(kind)) count += entry.count;
  }
  return count;
}

// Every polygon of every file is in the model or is counted by name among the dropped ones; wall,
// roof, ground and closure areas are those of the numbers in the file.
TEST(DataCounts, EveryPolygonIsReadOrNamed) {
  const std::vector<fs::path> files = CityGmlFiles();
  if (files.empty()) GTEST_SKIP() << "no city models at " << kData;
  for (const fs::path& file : files) {
    SCOPED_TRACE(file.string());
    const XmlCount expected = CountXml(file);
    const CityInfo info = DescribeCity({file}, {});
    std::size_t surfaces = 0;
    double area = 0.0;
    for (std::size_t c = 0; c < info.surfaces_of_class.size(); ++c) {
      surfaces += info.surfaces_of_class[c];
      area += info.area_of_class[c];
    }
    EXPECT_EQ(surfaces + Dropped(info), expected.polygons);
    ASSERT_EQ(info.files.size(), 1u);
    EXPECT_EQ(info.files[0].buildings, expected.buildings);
    // Degrees have no area in metres, and polygons given twice count once.
    const bool geographic = info.files[0].srs_names.size() == 1 &&
                            info.files[0].srs_names[0].find("6697") != std::string::npos;
    const bool repeated = info.dropped.entries().contains("polygons given twice dropped");
    const bool flat = surfaces == 0;
    if (geographic || repeated || flat) continue;
    // Welding at 5 mm moves corners; slivers and polygons whose outline crosses itself differ more.
    EXPECT_NEAR(area, expected.area, 3e-4 * expected.area + 0.5);
    const SurfaceClass classes[] = {
        SurfaceClass::kWall, SurfaceClass::kRoof, SurfaceClass::kGround, SurfaceClass::kClosure};
    if (info.classified_by_normal > 0) continue;
    for (std::size_t c = 0; c < 4; ++c) {
      const double found = info.area_of_class[static_cast<std::size_t>(classes[c])];
      EXPECT_NEAR(found, expected.area_of_class[c], 3e-4 * expected.area_of_class[c] + 0.5) << c;
    }
  }
}

TEST(DataCounts, TrianglesFaceAsTheirSurfacesDo) {
  const std::vector<fs::path> files = CityGmlFiles();
  if (files.empty()) GTEST_SKIP() << "no city models at " << kData;
  for (const fs::path& file : files) {
    SCOPED_TRACE(file.string());
    // The larger files would only take longer.
    if (fs::file_size(file) > 1'500'000 || CountXml(file).polygons == 0) continue;
    if (file.string().find("LYON_1ER") != std::string::npos) continue;
    const CityModel model = ReadCity({file}, {});
    EXPECT_GT(Volume(model), 0.0);
    EXPECT_FALSE(model.feature_edges.empty());
    for (const FeatureEdge& edge : model.feature_edges) {
      ASSERT_LT(edge.surface0, model.surfaces.size());
      ASSERT_TRUE(edge.surface1 == kNoSurface || edge.surface1 < model.surfaces.size());
      ASSERT_GT((edge.b - edge.a).norm(), 0.0);
    }
    for (const Surface& surface : model.surfaces) ASSERT_NEAR(surface.normal.norm(), 1.0f, 1e-5f);
  }
}

TEST(DataCounts, CityJsonFilesHoldAllTheirBuildings) {
  const fs::path folder = kData / "citygml";
  if (!fs::exists(folder)) GTEST_SKIP() << "no city models at " << folder;
  // Numbers of Building and BuildingPart objects with geometry, counted with jq.
  EXPECT_EQ(ReadCity({folder / "netherlands/3dfier_testarea.city.json"}, {}).buildings.size(),
            160u);
  EXPECT_EQ(
      ReadCity({folder / "netherlands/rotterdam_3-20-DELFSHAVEN.city.json"}, {}).buildings.size(),
      853u);
  const CityModel vienna = ReadCity({folder / "vienna/vienna_cjdb.jsonl"}, {});
  EXPECT_EQ(vienna.buildings.size(), 490u);
}

TEST(DataCounts, TheSameBuildingInTwoVersionsIsTheSame) {
  const fs::path folder = kData / "citygml/plateau";
  if (!fs::exists(folder)) GTEST_SKIP() << "no city models at " << folder;
  const CityModel two = ReadCity({folder / "53394517_bldg_6697_2_op_CityGML2.gml"}, {});
  const CityModel three = ReadCity({folder / "53394517_bldg_6697_2_op_CityGML3.gml"}, {});
  EXPECT_EQ(two.surfaces.size(), three.surfaces.size());
  EXPECT_EQ(two.feature_edges.size(), three.feature_edges.size());
  EXPECT_NEAR(Volume(two), Volume(three), 1e-6);
}

TEST(DataCounts, HeightsStrippedFromAFileAreNotInvented) {
  const fs::path file = kData / "citygml/lyon/LYON_1ER_BATI_2015-1_bldg-patched.gml";
  if (!fs::exists(file)) GTEST_SKIP() << "no file " << file;
  try {
    ReadCity({file}, {});
    FAIL() << "read";
  } catch (const std::exception& e) {
    EXPECT_NE(std::string(e.what()).find("187 polygons without heights"), std::string::npos)
        << e.what();
  }
}

}  // namespace
}  // namespace ridgeline::testing
