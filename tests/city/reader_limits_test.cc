// SPDX-License-Identifier: Apache-2.0
// Files that were made to hurt: each ends at once with one message that names the limit.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <zlib.h>

#include <string>

#include "base/error.h"
#include "city/city_text.h"
#include "city/read_city.h"

namespace ridgeline::testing {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

std::string ErrorOf(const std::filesystem::path& file) {
  try {
    ReadCity({file}, {});
  } catch (const InputError& e) {
    return e.what();
  }
  return {};
}

std::string ErrorOf(const std::string& name, const std::string& text) {
  const TestFolder folder;
  return ErrorOf(folder.Write(name, text));
}

std::string Repeated(const std::string& text, int count) {
  std::string all;
  for (int i = 0; i < count; ++i) all += text;
  return all;
}

constexpr int kMillion = 1'000'000;

TEST(ReaderLimits, JsonNestedAMillionDeep) {
  EXPECT_THAT(ErrorOf("a.json", "{\"type\":\"CityJSON\",\"x\":" + std::string(kMillion, '[')),
              HasSubstr("a.json: limit: got JSON nested deeper than 100"));
  EXPECT_THAT(ErrorOf("a.jsonl", std::string(kMillion, '[') + "\n{}"), HasSubstr("limit"));
}

TEST(ReaderLimits, BuildingPartsNestedAMillionDeep) {
  const std::string text =
      GmlDocument("<core:cityObjectMember><bldg:Building>" +
                  Repeated("<bldg:consistsOfBuildingPart><bldg:BuildingPart>", 20'000));
  EXPECT_THAT(ErrorOf("a.gml", text), HasSubstr("a.gml: limit: got elements nested deeper than"));
}

TEST(ReaderLimits, AHundredThousandHoles) {
  std::string holes;
  for (int i = 0; i < 5000; ++i) {
    const std::string x = std::to_string(i);
    holes += "<gml:interior><gml:LinearRing><gml:posList>" + x + " 1 5 " + x + ".5 1 5 " + x +
             " 2 5 " + x + " 1 5</gml:posList></gml:LinearRing></gml:interior>";
  }
  const std::string polygon =
      "<gml:Polygon gml:id=\"swiss\"><gml:exterior><gml:LinearRing><gml:posList>-1 0 5 9e5 0 5 9e5 "
      "9 5 -1 0 5</gml:posList></gml:LinearRing></gml:exterior>" +
      holes + "</gml:Polygon>";
  EXPECT_THAT(
      ErrorOf("a.gml", GmlDocument(GmlBuilding("a", GmlBoundary("RoofSurface", polygon)))),
      AllOf(HasSubstr("limit: got 5000 holes of polygon swiss"), HasSubstr("at most 1000")));
}

// Each level links ten times to the one below it: 10^7 polygons come out of 80 links.
TEST(ReaderLimits, FansOfLinks) {
  std::string members;
  for (int level = 7; level >= 0; --level) {
    std::string links;
    for (int i = 0; i < 10; ++i) {
      links += level == 0
                   ? "<gml:surfaceMember>" +
                         GmlPolygon({{0, 0, 5}, {i + 1.0, 0, 5}, {i + 1.0, 9, 5}}) +
                         "</gml:surfaceMember>"
                   : "<gml:surfaceMember xlink:href=\"#m" + std::to_string(level - 1) + "\"/>";
    }
    members +=
        GmlBuilding("b" + std::to_string(level),
                    "<bldg:lod2MultiSurface><gml:MultiSurface gml:id=\"m" + std::to_string(level) +
                        "\">" + links + "</gml:MultiSurface></bldg:lod2MultiSurface>");
  }
  EXPECT_THAT(ErrorOf("a.gml", GmlDocument(members)),
              HasSubstr("a.gml: limit: got links that stand for more than"));
}

TEST(ReaderLimits, CoordinatesOfNoPlaceOnEarth) {
  const std::string expected = "limit: got the coordinate 1e+300";
  EXPECT_THAT(ErrorOf("a.obj", "v 0 0 0\nv 1e300 0 0\nv 0 1 0\nf 1 2 3\n"), HasSubstr(expected));
  EXPECT_THAT(
      ErrorOf(
          "a.gml",
          GmlDocument(GmlBuilding(
              "a", GmlBoundary("RoofSurface", GmlPolygon({{0, 0, 5}, {1e300, 0, 5}, {9, 9, 5}}))))),
      HasSubstr(expected));
}

TEST(ReaderLimits, FilesThatGrowWithoutEndWhenUnpacked) {
  const TestFolder folder;
  const std::filesystem::path file = folder.path() / "bomb.gml.gz";
  gzFile out = gzopen(file.c_str(), "wb9");
  const std::string whole = GmlDocument("");
  const std::string head = whole.substr(0, whole.find("</core:CityModel>"));
  gzwrite(out, head.data(), static_cast<unsigned>(head.size()));
  const std::string spaces(kMillion, ' ');
  for (int i = 0; i < 100; ++i) gzwrite(out, spaces.data(), kMillion);
  gzclose(out);
  EXPECT_THAT(ErrorOf(file), HasSubstr("bomb.gml.gz: limit: got a file that grows"));
}

// A template of 3000 corners drawn 4000 times: 12 million points come out of a few kilobytes.
TEST(ReaderLimits, TemplatesDrawnThousandsOfTimes) {
  const std::string surfaces = Repeated("[[0,1,2]],", 999) + "[[0,1,2]]";
  const std::string instance =
      R"({"type":"GeometryInstance","template":0,"boundaries":[0],"transformationMatrix":)"
      "[1,0,0,0,0,1,0,0,0,0,1,0,0,0,0,1]}";
  const std::string text =
      R"({"type":"CityJSON","version":"1.1","vertices":[[0,0,0]],"geometry-templates":{)"
      R"("vertices-templates":[[0,0,0],[1,0,0],[1,1,1]],"templates":[{"type":"MultiSurface",)"
      R"("lod":"2","boundaries":[)" +
      surfaces + R"(]}]},"CityObjects":{"b":{"type":"Building","geometry":[)" +
      Repeated(instance + ",", 3999) + instance + "]}}}";
  EXPECT_THAT(ErrorOf("a.json", text),
              HasSubstr("a.json: limit: got templates that stand for more than 10000000 points"));
}

// Forty polygons of 300 corners each, all over one place and in one plane.
TEST(ReaderLimits, PolygonsThatLieInEachOther) {
  std::string members;
  for (int p = 0; p < 40; ++p) {
    Ring ring;
    for (int i = 0; i < 300; ++i) {
      const int k = p * 300 + i;
      ring.emplace_back(k * 7919 % 10007 * 0.01, k * 6007 % 10009 * 0.01, 5.0);
    }
    members += GmlBoundary("RoofSurface", GmlPolygon(ring));
  }
  EXPECT_THAT(ErrorOf("a.gml", GmlDocument(GmlBuilding("a", members))),
              HasSubstr("limit: got polygons that lie in each other"));
}

TEST(ReaderLimits, AKeyTwice) {
  EXPECT_THAT(ErrorOf("a.json",
                      R"({"type":"CityJSON","version":"1.1","vertices":[],"CityObjects":{)"
                      R"("b":{"type":"Building"},"b":{"type":"Building"}}})"),
              HasSubstr("a.json: got the key \"b\" twice"));
}

TEST(ReaderLimits, OnlyRegularFiles) {
  EXPECT_THAT(ErrorOf("/dev/zero"), HasSubstr("a pipe or a device"));
  const TestFolder folder;
  const std::filesystem::path pipe = folder.path() / "pipe.gml";
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  EXPECT_THAT(ErrorOf(pipe), HasSubstr("a pipe or a device"));
}

}  // namespace
}  // namespace ridgeline::testing
