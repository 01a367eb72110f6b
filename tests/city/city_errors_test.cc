// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "base/error.h"
#include "city/city_text.h"
#include "city/read_city.h"

namespace ridgeline::testing {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

const Eigen::Vector3d kSize(10, 8, 6);

std::string Box(const std::string& id = "a") { return GmlBox(id, kCorner, kCorner + kSize); }

// What the program would say of a model of this text; empty if it reads.
std::string ErrorOf(const std::string& text,
                    const std::string& name = "model.gml",
                    const CityOptions& options = {}) {
  const TestFolder folder;
  try {
    ReadCity({folder.Write(name, text)}, options);
  } catch (const InputError& e) {
    return e.what();
  }
  return {};
}

std::string PolygonOf(const std::string& numbers) {
  return GmlDocument(GmlBuilding(
      "a",
      GmlBoundary("RoofSurface",
                  "<gml:Polygon><gml:exterior><gml:LinearRing>\n<gml:posList>" + numbers +
                      "</gml:posList></gml:LinearRing></gml:exterior></gml:Polygon>")));
}

TEST(CityErrors, MissingFile) {
  try {
    ReadCity({"/nowhere/town.gml"}, {});
    FAIL();
  } catch (const InputError& e) {
    EXPECT_STREQ(e.what(), "/nowhere/town.gml: got no such file, expected a model file");
  }
}

TEST(CityErrors, FolderWithoutModels) {
  const TestFolder folder;
  folder.Write("readme.txt", "none here");
  try {
    ReadCity({folder.path()}, {});
    FAIL();
  } catch (const InputError& e) {
    EXPECT_THAT(e.what(), HasSubstr("got a folder without model files"));
  }
}

TEST(CityErrors, EmptyFile) { EXPECT_THAT(ErrorOf(""), HasSubstr("model.gml: got an empty file")); }

TEST(CityErrors, NotXml) {
  EXPECT_THAT(ErrorOf("PK\x03\x04 this is an archive"),
              AllOf(HasSubstr("line 1"), HasSubstr("text that is not XML")));
}

TEST(CityErrors, OtherXml) {
  EXPECT_THAT(ErrorOf("<?xml version=\"1.0\"?>\n<html></html>"),
              AllOf(HasSubstr("line 2"),
                    HasSubstr("an XML document of <html>"),
                    HasSubstr("a CityGML <CityModel>")));
}

TEST(CityErrors, TruncatedAtEveryTenth) {
  const std::string whole = GmlDocument(Box("a") + Box("b"));
  for (int tenth = 1; tenth < 10; ++tenth) {
    const std::string text = whole.substr(0, whole.size() * static_cast<std::size_t>(tenth) / 10);
    EXPECT_THAT(ErrorOf(text), HasSubstr("a file that ends early")) << tenth;
  }
}

TEST(CityErrors, EntitiesAreNotExpanded) {
  const std::string laughs =
      "<?xml version=\"1.0\"?>\n<!DOCTYPE lolz [\n<!ENTITY lol \"lol\">\n"
      "<!ENTITY lol2 \"&lol;&lol;&lol;&lol;&lol;&lol;&lol;&lol;\">\n]>\n"
      "<CityModel>&lol2;</CityModel>";
  EXPECT_THAT(ErrorOf(laughs), HasSubstr("a document type that declares entities"));
  const std::string external =
      "<?xml version=\"1.0\"?>\n<!DOCTYPE c [<!ENTITY x SYSTEM \"file:///etc/passwd\">]>\n"
      "<CityModel>&x;</CityModel>";
  EXPECT_THAT(ErrorOf(external), HasSubstr("a document type that declares entities"));
}

TEST(CityErrors, BadNumberNamesItsLine) {
  EXPECT_THAT(ErrorOf(PolygonOf("0 0 5 4 0 5 4 three 5 0 0 5")),
              AllOf(HasSubstr("line 6"), HasSubstr("\"three\" among coordinates")));
  EXPECT_THAT(ErrorOf(PolygonOf("0 0 5 4 0 nan 4 3 5 0 0 5")), HasSubstr("\"nan\""));
  EXPECT_THAT(ErrorOf(PolygonOf("0 0 5 4 0 1e999 4 3 5 0 0 5")), HasSubstr("\"1e999\""));
}

// Read as separators they would make 456160,5 two numbers.
TEST(CityErrors, DecimalCommas) {
  EXPECT_THAT(ErrorOf(PolygonOf("0,5 0 5 4,5 0 5 4,5 3 5 0,5 0 5")),
              HasSubstr("got \"0,5\" among coordinates, expected finite decimal numbers"));
}

TEST(CityErrors, EndlessWordFailsAtOnce) {
  EXPECT_THAT(ErrorOf(PolygonOf(std::string(1 << 20, '7'))), HasSubstr("among coordinates"));
}

TEST(CityErrors, UnknownEncoding) {
  EXPECT_THAT(ErrorOf("<?xml version=\"1.0\" encoding=\"klingon\"?><CityModel/>"),
              HasSubstr("an unknown text encoding"));
}

TEST(CityErrors, WrongEncoding) {
  std::string text =
      GmlDocument(Box("Stra\xDF"
                      "e"));
  EXPECT_THAT(ErrorOf(text), HasSubstr("text that is not XML"));
  text.replace(text.find("UTF-8"), 5, "windows-1252");
  EXPECT_EQ(ErrorOf(text), "");
}

TEST(CityErrors, UnknownSystem) {
  EXPECT_THAT(ErrorOf(GmlDocument(Box(), "urn:x:moon")),
              AllOf(HasSubstr("srsName: got \"urn:x:moon\""), HasSubstr("--model-crs")));
  EXPECT_THAT(ErrorOf(GmlDocument(Box(), "EPSG:99999")), HasSubstr("unknown to PROJ"));
}

TEST(CityErrors, MixedSystemsInAFile) {
  std::string text = GmlDocument(Box());
  text.replace(text.find("<gml:Polygon"), 12, "<gml:Polygon srsName=\"EPSG:25833\"");
  EXPECT_THAT(ErrorOf(text), HasSubstr("\"EPSG:25833\" beside \"EPSG:25832\""));
  CityOptions options;
  options.model_crs = "EPSG:25832";
  EXPECT_EQ(ErrorOf(text, "model.gml", options), "");
}

TEST(CityErrors, MixedSystemsInTwoFiles) {
  const TestFolder folder;
  const auto a = folder.Write("a.gml", GmlDocument(Box("a")));
  const auto b = folder.Write("b.gml", GmlDocument(Box("b"), "EPSG:31468"));
  try {
    ReadCity({a, b}, {});
    FAIL();
  } catch (const InputError& e) {
    EXPECT_THAT(e.what(),
                AllOf(HasSubstr("b.gml: CRS: got EPSG:31468"),
                      HasSubstr("expected EPSG:25832 (from"),
                      HasSubstr("a.gml")));
  }
}

TEST(CityErrors, MissingSystemIsAWarning) {
  const CityModel model = ReadGml(GmlDocument(Box(), ""));
  EXPECT_EQ(model.crs.horizontal_epsg, 0);
  EXPECT_THAT(model.warnings, ::testing::Contains(HasSubstr("no reference system in the model")));
}

TEST(CityErrors, NoBuilding) {
  EXPECT_THAT(ErrorOf(GmlDocument("")), HasSubstr("no building with a volume"));
  EXPECT_THAT(ErrorOf(GmlDocument(GmlBuilding("bare", ""))),
              AllOf(HasSubstr("no building with a volume"),
                    HasSubstr("1 buildings without geometry dropped (bare)")));
}

TEST(CityErrors, OptionsOutOfRange) {
  CityOptions options;
  options.weld_m = -1.0;
  EXPECT_THAT(ErrorOf(GmlDocument(Box()), "model.gml", options),
              HasSubstr("city.weld_m: got -1, expected [1e-06, 0.5]"));
  options = {};
  options.model_crs = "UTM";
  EXPECT_THAT(ErrorOf(GmlDocument(Box()), "model.gml", options),
              HasSubstr("city.model_crs: got \"UTM\""));
  options = {};
  options.lod = 5;
  EXPECT_THAT(ErrorOf(GmlDocument(Box()), "model.gml", options), HasSubstr("city.lod: got 5"));
}

TEST(CityErrors, CityJson) {
  EXPECT_THAT(ErrorOf("{\"type\":\"CityJSON\",", "m.city.json"),
              HasSubstr("a file that ends early"));
  EXPECT_THAT(ErrorOf("{\"type\":\"FeatureCollection\"}", "m.json"),
              HasSubstr("type: got \"FeatureCollection\", expected \"CityJSON\""));
  EXPECT_THAT(ErrorOf("{\"type\":\"CityJSON\",\"version\":\"9.0\"}", "m.json"),
              HasSubstr("version: got \"9.0\""));
  EXPECT_THAT(ErrorOf("{\"type\":\"CityJSON\",\"version\":\"2.0\"}", "m.json"),
              HasSubstr("CityObjects"));
  const std::string bad_index =
      R"({"type":"CityJSON","version":"2.0","vertices":[[0,0,0]],"CityObjects":{"h":{)"
      R"("type":"Building","geometry":[{"type":"MultiSurface","lod":"2","boundaries":[[[0,0,7]]]}]}}})";
  EXPECT_THAT(ErrorOf(bad_index, "m.json"),
              AllOf(HasSubstr("CityObjects.h.geometry[0]"), HasSubstr("got vertex 7")));
}

TEST(CityErrors, CityJsonStructureNamesItsPlace) {
  const auto error_of = [](const std::string& geometry) {
    return ErrorOf(
        R"({"type":"CityJSON","version":"2.0","vertices":[[0,0,0],[1,0,0],[0,1,0]],)"
        R"("CityObjects":{"h":{"type":"Building","geometry":[{"type":"MultiSurface","lod":"2",)" +
            geometry + "}]}}}",
        "m.json");
  };
  EXPECT_THAT(error_of(R"("boundaries":[[[0,1.5,2]]])"),
              HasSubstr("CityObjects.h.geometry[0]: got vertex 1.5, expected a whole number"));
  EXPECT_THAT(error_of(R"("boundaries":[[["0",1,2]]])"), HasSubstr("got vertex \"0\""));
  EXPECT_THAT(error_of(R"("boundaries":[[[0,1,2]]],"semantics":{"surfaces":[]})"),
              HasSubstr("CityObjects.h.geometry[0]: got a CityJSON structure error"));
  EXPECT_THAT(
      ErrorOf("{\"type\":\"CityJSON\",\"version\":\"2.0\",\"CityObjects\":{\"h\":5}}", "m.json"),
      HasSubstr("CityObjects.h: got a CityJSON structure error"));
  EXPECT_THAT(
      ErrorOf("{\"type\":\"CityJSON\",\"version\":\"2.0\",\"CityObjects\":{}}\n5\n{}\n", "m.jsonl"),
      HasSubstr("m.jsonl: line 2: got number, expected an object"));
}

TEST(CityErrors, MeshFiles) {
  EXPECT_THAT(ErrorOf("v 0 0 0\nv 1 0 x\n", "m.obj"),
              AllOf(HasSubstr("line 2"), HasSubstr("\"x\"")));
  EXPECT_THAT(ErrorOf("v 0 0 0\nf 1 2 3\n", "m.obj"),
              AllOf(HasSubstr("line 2"), HasSubstr("among the 1 before it")));
  EXPECT_THAT(ErrorOf("hello", "m.obj"), HasSubstr("no vertices"));
  EXPECT_THAT(
      ErrorOf("ply\nformat ascii 1.0\nelement vertex 2\nproperty float x\nproperty float y\n"
              "property float z\nelement face 0\nproperty list uchar int vertex_index\nend_header\n"
              "0 0 0\n1 1",
              "m.ply"),
      AllOf(HasSubstr("vertex[1]"), HasSubstr("a file that ends early")));
  const std::string head = "ply\nformat ascii 1.0\n";
  const std::string vertices =
      "element vertex 1\nproperty float x\nproperty float y\nproperty float z\n";
  EXPECT_THAT(ErrorOf(head + vertices + "end_header\n0 0 0\n", "m.ply"),
              HasSubstr("header: got no element \"face\", expected faces"));
  EXPECT_THAT(ErrorOf(head + "element face 0\nproperty list uchar int vertex_index\n" + vertices +
                          "end_header\n0 0 0\n",
                      "m.ply"),
              HasSubstr("header: got faces before vertices"));
  EXPECT_THAT(ErrorOf("ply\nformat middle_endian 1.0\nend_header\n", "m.ply"),
              HasSubstr("format: got \"middle_endian\""));
}

}  // namespace
}  // namespace ridgeline::testing
