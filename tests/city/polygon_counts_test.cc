// SPDX-License-Identifier: Apache-2.0
// Every polygon of a file is read or named, in every format: against counts that were made with the
// file. Folders lose nothing in silence either.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <string>

#include "base/error.h"
#include "city/city_info.h"
#include "city/city_text.h"
#include "city/format/formats.h"
#include "city/format/model_files.h"
#include "city/read_city.h"
#include "support/source_folder.h"

namespace ridgeline::testing {
namespace {

using ::testing::AllOf;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

const std::string kVertices =
    "[[0,0,0],[10000,0,0],[10000,8000,0],[0,8000,0],"
    "[0,0,6000],[10000,0,6000],[10000,8000,6000],[0,8000,6000]]";
const std::string kWalls = "[[0,1,5,4]],[[1,2,6,5]],[[2,3,7,6]],[[3,0,4,7]]";
const std::string kRoofAndGround = "[[4,5,6,7]],[[0,3,2,1]]";
const std::string kHead =
    R"("version":"2.0","transform":{"scale":[0.001,0.001,0.001],"translate":[691000,5336000,500]})"
    R"(,"metadata":{"referenceSystem":"https://www.opengis.net/def/crs/EPSG/0/25832"})";

std::string MultiSurface(const std::string& lod, const std::string& surfaces) {
  return R"({"type":"MultiSurface","lod":")" + lod + R"(","boundaries":[)" + surfaces + "]}";
}

std::string BuildingOf(const std::string& geometries) {
  return R"({"type":"Building","geometry":[)" + geometries + "]}";
}

std::string Document(const std::string& objects) {
  return R"({"type":"CityJSON",)" + kHead + R"(,"vertices":)" + kVertices + R"(,"CityObjects":{)" +
         objects + "}}";
}

const std::string kLine = R"({"type":"MultiLineString","lod":"2","boundaries":[[0,1,2,3]]})";
const std::string kSolid =
    R"({"type":"Solid","lod":"2","boundaries":[[)" + kWalls + "," + kRoofAndGround + "]]}";

CityInfo Describe(const std::string& name, const std::string& text) {
  const TestFolder folder;
  return DescribeCity({folder.Write(name, text)}, {});
}

void ExpectWholeBox(const CityInfo& info) {
  const auto count = [&](SurfaceClass c) {
    return info.surfaces_of_class[static_cast<std::size_t>(c)];
  };
  EXPECT_EQ(count(SurfaceClass::kWall), 4u);
  EXPECT_EQ(count(SurfaceClass::kRoof), 1u);
  EXPECT_EQ(count(SurfaceClass::kGround), 1u);
  EXPECT_EQ(info.triangles, 12u);
  EXPECT_THAT(info.open_shells, IsEmpty());
}

TEST(CityJsonGeometries, OfOneLevelAreOneShape) {
  const std::string walls = MultiSurface("2", kWalls);
  const std::string rest = MultiSurface("2.0", kRoofAndGround);
  for (const std::string& geometries : {walls + "," + rest, rest + "," + walls}) {
    ExpectWholeBox(Describe("a.json", Document(R"("h":)" + BuildingOf(geometries))));
  }
}

TEST(CityJsonGeometries, LinesNeverReplaceSurfaces) {
  for (const std::string& geometries : {kLine + "," + kSolid, kSolid + "," + kLine}) {
    const CityInfo info = Describe("a.json", Document(R"("h":)" + BuildingOf(geometries)));
    ExpectWholeBox(info);
    EXPECT_THAT(info.warnings,
                Contains(HasSubstr("1 MultiLineString geometries (no surfaces) passed over")));
  }
}

TEST(CityJsonGeometries, OnlyTheFinestFractionReplacesOthersAndSaysSo) {
  const CityInfo info =
      Describe("a.json",
               Document(R"("h":)" + BuildingOf(MultiSurface("2.0", "[[0,3,2,1]]") + "," +
                                               MultiSurface("2.2", kWalls) + "," +
                                               MultiSurface("1.3", kRoofAndGround) + "," +
                                               MultiSurface("2.2", kRoofAndGround))));
  ExpectWholeBox(info);
  const PolygonCount lod2 = info.files[0].polygons.at(2);
  EXPECT_EQ(lod2.met, 7u);
  EXPECT_EQ(lod2.read, 6u);
  EXPECT_EQ(lod2.named, 1u);
  EXPECT_THAT(info.warnings, Contains(HasSubstr("1 polygons of a coarser fraction")));
}

TEST(CityJsonGeometries, PartsInACircleAreRefused) {
  const std::string a = R"("a":{"type":"BuildingPart","parents":["b"],"geometry":[]})";
  const std::string b = R"("b":{"type":"BuildingPart","parents":["a"],"geometry":[]})";
  try {
    Describe("a.json", Document(a + "," + b));
    FAIL();
  } catch (const InputError& e) {
    EXPECT_THAT(e.what(), HasSubstr("a.json: limit: got more than 64 parents"));
  }
}

// The wanted level of one file per format, with everything that can happen to a polygon in it.
struct Sample {
  const char* format;
  const char* name;
  std::string text;
  std::size_t polygons;  // of LoD2, counted by hand
  std::size_t named;
};

const std::string kBigTriangle = "0 0 5 9 0 5 9 9 5 0 0 5";

std::string GmlOf(const std::string& numbers) {
  return "<gml:Polygon><gml:exterior><gml:LinearRing><gml:posList>" + numbers +
         "</gml:posList></gml:LinearRing></gml:exterior></gml:Polygon>";
}

std::vector<Sample> Samples() {
  const Eigen::Vector3d size(10, 8, 6);
  // 6 of the box, 1 without heights, 1 of two points, 1 repeated in a solid.
  const std::string solid =
      "<bldg:lod2Solid><gml:Solid><gml:exterior><gml:CompositeSurface><gml:surfaceMember>" +
      GmlOf(kBigTriangle) +
      "</gml:surfaceMember></gml:CompositeSurface></gml:exterior></gml:Solid></bldg:lod2Solid>";
  const std::string gml =
      GmlDocument(GmlBox("a", kCorner, kCorner + size) +
                      GmlBuilding("b",
                                  GmlBoundary("RoofSurface", GmlOf("0 0 9 0 9 9 0 0")) +
                                      GmlBoundary("RoofSurface", GmlOf("1 1 1 2 2 2 1 1 1")) +
                                      GmlBoundary("RoofSurface", GmlOf(kBigTriangle)) + solid),
                  "");
  const std::string json =
      Document(R"("h":)" +
               BuildingOf(kSolid + "," + kLine + "," + MultiSurface("2", "[[0,1]]") + "," +
                          R"({"type":"Solid","lod":"2","boundaries":[[[[0,1,5]]],[[[1,2,6]]]]})"));
  const std::string obj = "v 0 0 0\nv 10 0 0\nv 10 8 0\nv 0 8 6\nf 1 2 3\nf 1 2 4\nf 1 2\n";
  const std::string ply =
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
      "property float z\nelement face 2\nproperty list uchar int vertex_indices\nend_header\n"
      "0 0 0\n5 0 0\n5 5 3\n3 0 1 2\n2 0 1\n";
  return {{"CityGML", "a.gml", gml, 10, 3},
          {"CityJSON", "a.json", json, 9, 2},
          {"OBJ", "a.obj", obj, 3, 1},
          {"PLY", "a.ply", ply, 2, 1}};
}

TEST(PolygonCounts, ReadAndNamedMakeAllInEveryFormat) {
  const std::vector<Sample> samples = Samples();
  for (const CityFormat& format : CityFormats()) {
    const auto sample = std::find_if(
        samples.begin(), samples.end(), [&](const Sample& s) { return s.format == format.name; });
    ASSERT_NE(sample, samples.end()) << "no sample of " << format.name;
    SCOPED_TRACE(sample->name);
    const CityInfo info = Describe(sample->name, sample->text);
    const PolygonCount count = info.files[0].polygons.at(2);
    EXPECT_EQ(count.met, sample->polygons);
    EXPECT_EQ(count.named, sample->named);
    EXPECT_EQ(count.read, sample->polygons - sample->named);
    EXPECT_THAT(info.warnings, ::testing::Not(Contains(HasSubstr("a fault of ridgeline"))));
  }
}

TEST(ModelFolder, KeysInAnyOrderAndEveryNameAreFound) {
  const TestFolder folder;
  const std::string house = BuildingOf(kSolid);
  folder.Write("plain.json", Document(R"("p":)" + house));
  // In alphabetical order "type" comes last, behind much more than a first look sees.
  std::string many;
  for (int i = 0; i < 40; ++i) {
    many += (i == 0 ? "\"s" : ",\"s") + std::to_string(i) + "\":" + house;
  }
  const std::string sorted = R"({"CityObjects":{)" + many + R"(},)" +
                             R"("metadata":{"referenceSystem":"EPSG:25832"},"transform":)"
                             R"({"scale":[0.001,0.001,0.001],"translate":[691000,5336000,500]},)"
                             R"("type":"CityJSON","version":"2.0","vertices":)" +
                             kVertices + "}";
  ASSERT_GT(sorted.find("\"type\":\"CityJSON\""), 4096u);
  folder.Write("sorted.json", sorted);
  folder.Write("third.cityjson", Document(R"("t":)" + house));
  folder.Write("camera.json", R"({"width": 100})");
  folder.Write("below/notes.txt", "no city");
  const ModelFiles listed = ListModelFiles({folder.path()});
  EXPECT_EQ(listed.files.size(), 3u);
  ASSERT_EQ(listed.warnings.size(), 1u);
  EXPECT_THAT(listed.warnings[0],
              AllOf(HasSubstr("passed over"), HasSubstr("1 *.json"), HasSubstr("1 *.txt")));
  const CityInfo info = DescribeCity({folder.path()}, {});
  std::size_t buildings = 0;
  for (const ModelFileInfo& file : info.files) buildings += file.buildings;
  EXPECT_EQ(buildings, 42u);
  EXPECT_THAT(info.warnings, Contains(HasSubstr("passed over")));
}

TEST(ModelFolder, WithoutModelsSaysWhatItHolds) {
  const TestFolder folder;
  folder.Write("camera.json", R"({"width": 100})");
  try {
    ListModelFiles({folder.path()});
    FAIL();
  } catch (const InputError& e) {
    EXPECT_THAT(e.what(), AllOf(HasSubstr("(1 *.json)"), HasSubstr("*.cityjson")));
  }
}

TEST(ModelFile, OfNoKnownNameIsToldByItsContent) {
  const TestFolder folder;
  const std::string text = GmlDocument(GmlBox("a", kCorner, kCorner + Eigen::Vector3d(10, 8, 6)));
  EXPECT_EQ(ReadModelFile(folder.Write("download", text)).format, "CityGML 2.0");
  EXPECT_EQ(
      ReadModelFile(folder.Write("download2", Document(R"("h":)" + BuildingOf(kSolid)))).format,
      "CityJSON 2.0");
  EXPECT_THROW(ReadModelFile(folder.Write("notes.txt", "none")), InputError);
}

// The docs name every extension of the table.
TEST(ModelFile, DocsNameEveryExtension) {
  const std::filesystem::path docs = std::filesystem::path(kSourceFolder) / "docs/city_data.md";
  InputFile file(docs);
  const std::string text = file.ReadAll();
  for (const CityFormat& format : CityFormats()) {
    EXPECT_THAT(text, HasSubstr(std::string(format.name)));
    for (const auto* list : {&format.extensions, &format.shared_extensions}) {
      for (const std::string_view extension : *list) {
        EXPECT_THAT(text, HasSubstr("`*" + std::string(extension) + "`"));
      }
    }
  }
}

}  // namespace
}  // namespace ridgeline::testing
