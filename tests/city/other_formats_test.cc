// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <zlib.h>

#include <Eigen/Geometry>
#include <cstring>
#include <string>

#include "city/city_text.h"
#include "city/read_city.h"

namespace ridgeline::testing {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;

CityModel Read(const std::string& name, const std::string& text, const CityOptions& options = {}) {
  const TestFolder folder;
  return ReadCity({folder.Write(name, text)}, options);
}

std::size_t Count(const CityModel& model, SurfaceClass surface_class) {
  std::size_t count = 0;
  for (const Surface& s : model.surfaces) count += s.surface_class == surface_class ? 1 : 0;
  return count;
}

// A box of 10 x 8 x 6 m; vertices in mm relative to kCorner.
const std::string kVertices =
    "[[0,0,0],[10000,0,0],[10000,8000,0],[0,8000,0],"
    "[0,0,6000],[10000,0,6000],[10000,8000,6000],[0,8000,6000]]";
const std::string kSurfaces =
    "[[[0,1,5,4]],[[1,2,6,5]],[[2,3,7,6]],[[3,0,4,7]],[[4,5,6,7]],[[0,3,2,1]]]";
const std::string kSemantics =
    R"({"surfaces":[{"type":"WallSurface"},{"type":"RoofSurface"},{"type":"GroundSurface"}],)"
    R"("values":[[0,0,0,0,1,2]]})";
const std::string kTransform =
    R"("transform":{"scale":[0.001,0.001,0.001],"translate":[691000,5336000,500]})";
const std::string kMetadata =
    R"("metadata":{"referenceSystem":"https://www.opengis.net/def/crs/EPSG/0/25832"})";

std::string SolidOf(const std::string& lod) {
  return R"({"type":"Solid","lod":")" + lod + R"(","boundaries":[)" + kSurfaces +
         R"(],"semantics":)" + kSemantics + "}";
}

std::string CityJson(const std::string& objects) {
  return R"({"type":"CityJSON","version":"2.0",)" + kTransform + "," + kMetadata +
         R"(,"vertices":)" + kVertices + R"(,"CityObjects":{)" + objects + "}}";
}

void ExpectBox(const CityModel& model) {
  EXPECT_EQ(model.vertices.size(), 8u);
  EXPECT_EQ(Count(model, SurfaceClass::kWall), 4u);
  EXPECT_EQ(Count(model, SurfaceClass::kRoof), 1u);
  EXPECT_EQ(Count(model, SurfaceClass::kGround), 1u);
  EXPECT_NEAR(Volume(model), 480.0, 1e-6);
  EXPECT_NEAR((model.vertices[0] + model.origin_in_world - kCorner).norm(), 0.0, 1e-6);
}

TEST(CityJson, SolidWithSemantics) {
  const CityModel model =
      Read("a.city.json", CityJson(R"("h":{"type":"Building","geometry":[)" + SolidOf("2") + "]}"));
  ExpectBox(model);
  EXPECT_EQ(model.buildings[0].id, "h");
  EXPECT_EQ(model.crs.horizontal_epsg, 25832);
}

TEST(CityJson, MultiSurfaceWithoutSemanticsIsClassifiedByNormal) {
  ExpectBox(Read("a.json",
                 CityJson(R"("h":{"type":"Building","geometry":[{"type":"MultiSurface","lod":"2",)"
                          R"("boundaries":)" +
                          kSurfaces + "}]}")));
}

TEST(CityJson, FinestRefinementOfALevelIsTaken) {
  const std::string flat = R"({"type":"MultiSurface","lod":"2.0","boundaries":[[[0,3,2,1]]]})";
  ExpectBox(Read("a.json",
                 CityJson(R"("h":{"type":"Building","geometry":[)" + flat + "," + SolidOf("2.2") +
                          "," + SolidOf("1.3") + "]}")));
}

TEST(CityJson, PartsKnowTheirParentInAnyOrder) {
  const CityModel model =
      Read("a.json",
           CityJson(R"("a-part":{"type":"BuildingPart","parents":["whole"],"geometry":[)" +
                    SolidOf("2") + R"(]},"whole":{"type":"Building"})"));
  ExpectBox(model);
  EXPECT_EQ(model.buildings[0].parent_id, "whole");
  EXPECT_TRUE(model.warnings.empty());
}

TEST(CityJson, TemplatesAreMovedToTheirPlace) {
  const std::string text =
      R"({"type":"CityJSON","version":"1.1",)" + kTransform +
      R"(,"vertices":[[1000,2000,0]],"geometry-templates":{"vertices-templates":)"
      R"([[0,0,0],[2,0,0],[0,1,0]],"templates":[{"type":"MultiSurface","lod":"2",)"
      R"("boundaries":[[[0,1,2]]]}]},"CityObjects":{"h":{"type":"Building","geometry":)"
      R"([{"type":"GeometryInstance","template":0,"boundaries":[0],)"
      R"("transformationMatrix":[3,0,0,0,0,3,0,0,0,0,3,0,0,0,0,1]}]}}})";
  const CityModel model = Read("a.json", text);
  EXPECT_NEAR(Area(model), 9.0, 1e-9);
  EXPECT_NEAR(
      (model.vertices[0] + model.origin_in_world - kCorner - Eigen::Vector3d(1, 2, 0)).norm(),
      0.0,
      1e-9);
}

TEST(CityJson, SequenceOfFeatures) {
  const auto feature = [](const std::string& id) {
    return R"({"type":"CityJSONFeature","id":")" + id + R"(","vertices":)" + kVertices +
           R"(,"CityObjects":{")" + id + R"(":{"type":"Building","geometry":[)" + SolidOf("2") +
           "]}}}\n";
  };
  const std::string header = R"({"type":"CityJSON","version":"2.0",)" + kTransform + "," +
                             kMetadata + R"(,"vertices":[],"CityObjects":{}})" + "\n";
  ExpectBox(Read("a.jsonl", header + feature("h")));
  const CityModel model = Read("b.city.jsonl", header + feature("h") + "\n" + feature("i"));
  EXPECT_EQ(model.buildings.size(), 2u);
}

const std::string kObjFaces =
    "v 0 0 0\nv 10 0 0\nv 10 8 0\nv 0 8 0\nv 0 0 6\nv 10 0 6\nv 10 8 6\nv 0 8 6\n"
    "f 1 2 6 5\nf 2/1/1 3/2/1 7//1 6\nf -6 -5 -1 -2\nf 4 1 5 8\nf 5 6 7 8\nf 1 4 3 2\n";

TEST(Obj, OffsetAndSystemFromComments) {
  const CityModel model =
      Read("a.obj", "# offset 691000 5336000 500\n# crs EPSG:25832\n" + kObjFaces);
  ExpectBox(model);
  EXPECT_EQ(model.crs.horizontal_epsg, 25832);
}

TEST(Obj, OffsetAndSystemFromASidecar) {
  const TestFolder folder;
  folder.Write("a.obj.offset", "691000 5336000 500\ncrs EPSG:25832+7837\n");
  const CityModel model = ReadCity({folder.Write("a.obj", kObjFaces)}, {});
  ExpectBox(model);
  EXPECT_EQ(model.crs.vertical_epsg, 7837);
}

TEST(Obj, ObjectsAreBuildingsAndGroupsGiveClasses) {
  const CityModel model = Read("a.obj",
                               "o house_1\n" + kObjFaces +
                                   "o house_2\ng steep_Dach\nv 20 0 0\nv 21 0 0\n"
                                   "v 21 0 5\nf 9 10 11\n");
  ASSERT_EQ(model.buildings.size(), 2u);
  EXPECT_EQ(model.buildings[1].id, "house_2");
  EXPECT_EQ(model.surfaces.back().surface_class, SurfaceClass::kRoof);
}

TEST(Obj, MarkOfByteOrderAndLinesThatGoOn) {
  std::string text = kObjFaces;
  text.replace(text.find("2 6 5"), 5, "2 \\\r\n6 5");
  ExpectBox(Read("a.obj", "\xEF\xBB\xBF" + text + "# offset 691000 5336000 500 \\"));
}

TEST(Obj, UnnamedMeshIsSplitIntoConnectedParts) {
  const CityModel model =
      Read("a.obj", kObjFaces + "v 30 0 0\nv 40 0 0\nv 40 8 0\nv 0 0 0\nf 9 10 11\n");
  EXPECT_EQ(model.buildings.size(), 2u);
}

TEST(Ply, AsciiAndBinaryAgree) {
  const std::string header_end =
      "comment offset 691000 5336000 500\ncomment crs EPSG:25832\nelement vertex 8\n"
      "property double x\nproperty double y\nproperty double z\nelement face 6\n"
      "property list uchar int vertex_indices\nend_header\n";
  const double v[8][3] = {
      {0, 0, 0}, {10, 0, 0}, {10, 8, 0}, {0, 8, 0}, {0, 0, 6}, {10, 0, 6}, {10, 8, 6}, {0, 8, 6}};
  const int f[6][4] = {
      {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}, {4, 5, 6, 7}, {0, 3, 2, 1}};
  std::string ascii = "ply\nformat ascii 1.0\n" + header_end;
  std::string little = "ply\nformat binary_little_endian 1.0\n" + header_end;
  std::string big = "ply\nformat binary_big_endian 1.0\n" + header_end;
  const auto append = [&](const auto& value) {
    char bytes[sizeof(value)];
    std::memcpy(bytes, &value, sizeof(value));
    little.append(bytes, sizeof(value));
    for (std::size_t i = sizeof(value); i-- > 0;) big.push_back(bytes[i]);
  };
  for (const auto& p : v) {
    for (const double x : p) {
      ascii += std::to_string(x) + " ";
      append(x);
    }
    ascii += "\n";
  }
  for (const auto& face : f) {
    ascii += "4 ";
    append(static_cast<unsigned char>(4));
    for (const int i : face) {
      ascii += std::to_string(i) + " ";
      append(i);
    }
    ascii += "\n";
  }
  ExpectBox(Read("a.ply", ascii));
  ExpectBox(Read("b.ply", little));
  ExpectBox(Read("c.ply", big));
}

TEST(Gzip, CompressedTilesAreRead) {
  const TestFolder folder;
  const std::string text = GmlDocument(GmlBox("a", kCorner, kCorner + Eigen::Vector3d(10, 8, 6)));
  const std::filesystem::path file = folder.path() / "tile.gml.gz";
  gzFile out = gzopen(file.c_str(), "wb");
  gzwrite(out, text.data(), static_cast<unsigned>(text.size()));
  gzclose(out);
  ExpectBox(ReadCity({file}, {}));
}

TEST(Geographic, HeightsAboveTheEllipsoidAreAWarning) {
  const Ring ring{{48.1, 11.5, 560}, {48.1, 11.5001, 560}, {48.1001, 11.5001, 560}};
  const std::string text =
      GmlDocument(GmlBuilding("a", GmlBoundary("RoofSurface", GmlPolygon(ring))), "EPSG:4979");
  const CityModel as_written = ReadGml(text);
  EXPECT_THAT(as_written.warnings, Contains(HasSubstr("heights above the ellipsoid")));
  EXPECT_EQ(as_written.crs.horizontal_epsg, 32632);
  CityOptions options;
  options.height_offset_m = -45.5;
  const CityModel moved = ReadGml(text, options);
  EXPECT_THAT(moved.warnings, ::testing::IsEmpty());
  const auto height = [](const CityModel& m) { return m.vertices[0].z() + m.origin_in_world.z(); };
  EXPECT_NEAR(height(moved), height(as_written) - 45.5, 1e-9);
}

TEST(Geographic, LatitudeLongitudeHeightIsProjected) {
  // A square of 0.0001 degrees at 35.68 N, 139.77 E: 11.1 m by 9.05 m.
  const Ring ring{
      {35.68, 139.77, 5}, {35.68, 139.7701, 5}, {35.6801, 139.7701, 5}, {35.6801, 139.77, 5}};
  const CityModel model =
      ReadGml(GmlDocument(GmlBuilding("a", GmlBoundary("RoofSurface", GmlPolygon(ring))),
                          "http://www.opengis.net/def/crs/EPSG/0/6697"));
  EXPECT_EQ(model.crs.horizontal_epsg, 6691);
  EXPECT_EQ(model.crs.vertical_epsg, 6695);
  // GRS 80 at this latitude: 110.953 km per degree of latitude, 90.54 km per degree of longitude,
  // times the UTM scale of 0.9997.
  EXPECT_NEAR(Area(model), 11.0953 * 9.0536, 0.15);
  EXPECT_GT(model.surfaces[0].normal.z(), 0.99f);
}

}  // namespace
}  // namespace ridgeline::testing
