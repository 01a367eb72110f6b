// SPDX-License-Identifier: Apache-2.0
#include "city/format/read_citygml.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <string>

#include "city/city_text.h"

namespace ridgeline::testing {
namespace {

using Eigen::Vector3d;

const Vector3d kSize(10, 8, 6);

std::vector<Ring> Box() { return BoxRings(kCorner, kCorner + kSize); }

std::string Member(const std::string& content) {
  return "<gml:surfaceMember>" + content + "</gml:surfaceMember>";
}

std::string Link(const std::string& id) {
  return "<gml:surfaceMember xlink:href=\"#" + id + "\"/>";
}

std::string Solid(const std::string& members, int lod = 2) {
  const std::string property = "bldg:lod" + std::to_string(lod) + "Solid";
  return "<" + property + "><gml:Solid><gml:exterior><gml:CompositeSurface>" + members +
         "</gml:CompositeSurface></gml:exterior></gml:Solid></" + property + ">\n";
}

// The box as a solid written out, without boundary surfaces.
std::string BoxSolid(const Vector3d& low, const Vector3d& high, int lod = 2) {
  std::string members;
  for (const Ring& ring : BoxRings(low, high)) members += Member(GmlPolygon(ring));
  return Solid(members, lod);
}

std::size_t Count(const CityModel& model, SurfaceClass surface_class) {
  return static_cast<std::size_t>(
      std::count_if(model.surfaces.begin(), model.surfaces.end(), [&](const Surface& s) {
        return s.surface_class == surface_class;
      }));
}

bool Warns(const CityModel& model, const std::string& text) {
  return std::any_of(model.warnings.begin(), model.warnings.end(), [&](const std::string& w) {
    return w.find(text) != std::string::npos;
  });
}

void ExpectBox(const CityModel& model) {
  EXPECT_EQ(model.vertices.size(), 8u);
  EXPECT_EQ(model.triangles.size(), 12u);
  EXPECT_EQ(Count(model, SurfaceClass::kWall), 4u);
  EXPECT_EQ(Count(model, SurfaceClass::kRoof), 1u);
  EXPECT_EQ(Count(model, SurfaceClass::kGround), 1u);
  EXPECT_NEAR(Volume(model), kSize.prod(), 1e-6);
}

TEST(ReadCityGml, BoundarySurfacesMakeAClosedBox) {
  const CityModel model = ReadGml(GmlDocument(GmlBox("house", kCorner, kCorner + kSize)));
  ExpectBox(model);
  ASSERT_EQ(model.buildings.size(), 1u);
  EXPECT_EQ(model.buildings[0].id, "house");
  EXPECT_EQ(model.crs.horizontal_epsg, 25832);
  EXPECT_TRUE(model.warnings.empty());
  // The vertices, moved back to the world, are the corners written.
  const Vector3d world = model.vertices[0] + model.origin_in_world;
  EXPECT_NEAR((world - kCorner).norm(), 0.0, 1e-9);
}

TEST(ReadCityGml, SolidWithoutSurfacesIsClassifiedByNormal) {
  ExpectBox(ReadGml(GmlDocument(GmlBuilding("a", BoxSolid(kCorner, kCorner + kSize)))));
}

TEST(ReadCityGml, SolidThatLinksToBoundarySurfacesAddsNothing) {
  const std::vector<Ring> rings = Box();
  const char* types[] = {
      "WallSurface", "WallSurface", "WallSurface", "WallSurface", "RoofSurface", "GroundSurface"};
  std::string links;
  std::string content;
  for (std::size_t i = 0; i < 6; ++i) {
    const std::string id = "p" + std::to_string(i);
    links += Link(id);
    content += GmlBoundary(types[i], GmlPolygon(rings[i], {}, id));
  }
  // Forward links: the solid comes first, as in AdV files.
  ExpectBox(ReadGml(GmlDocument(GmlBuilding("a", Solid(links) + content))));
}

TEST(ReadCityGml, BoundarySurfacesMayLinkToTheSolid) {
  const std::vector<Ring> rings = Box();
  std::string members;
  for (std::size_t i = 0; i < 6; ++i) {
    members += Member(GmlPolygon(rings[i], {}, "p" + std::to_string(i)));
  }
  const std::string closure =
      "<bldg:boundedBy><bldg:ClosureSurface><bldg:lod2MultiSurface><gml:MultiSurface>" +
      Link("p0") +
      "</gml:MultiSurface></bldg:lod2MultiSurface></bldg:ClosureSurface></bldg:boundedBy>";
  const CityModel model =
      ReadGml(GmlDocument(GmlBuilding("a", Solid(members + Link("p0")) + closure)));
  EXPECT_EQ(model.surfaces.size(), 6u);
  EXPECT_EQ(Count(model, SurfaceClass::kClosure), 1u);
  EXPECT_EQ(Count(model, SurfaceClass::kWall), 3u);
}

TEST(ReadCityGml, SolidBesideBoundarySurfacesIsNotCountedTwice) {
  const std::string box = GmlBox("a", kCorner, kCorner + kSize);
  const std::size_t end = box.find("</bldg:Building>");
  const CityModel model = ReadGml(
      GmlDocument(box.substr(0, end) + BoxSolid(kCorner, kCorner + kSize) + box.substr(end)));
  ExpectBox(model);
  EXPECT_TRUE(Warns(model, "6 polygons of solids not used beside boundary surfaces (a)"));
}

TEST(ReadCityGml, LinksThatLeadNowhereAreCounted) {
  const std::string box = GmlBox("a", kCorner, kCorner + kSize);
  const std::size_t end = box.find("</bldg:Building>");
  const CityModel model = ReadGml(
      GmlDocument(box.substr(0, end) + Solid(Link("none") + Link("gone")) + box.substr(end)));
  ExpectBox(model);
  EXPECT_TRUE(Warns(model, "2 links to geometry that the file does not hold (a)"));
}

TEST(ReadCityGml, HoleIsCutOut) {
  const auto p = [](double x, double y) { return Vector3d(kCorner + Vector3d(x, y, 5)); };
  const Ring outer{p(0, 0), p(10, 0), p(10, 10), p(0, 10)};
  // A hole in either direction of travel.
  const Ring clockwise{p(4, 4), p(4, 6), p(6, 6), p(6, 4)};
  const Ring counter{p(1, 1), p(3, 1), p(3, 3), p(1, 3)};
  const CityModel model = ReadGml(GmlDocument(
      GmlBuilding("a", GmlBoundary("RoofSurface", GmlPolygon(outer, {clockwise, counter})))));
  EXPECT_NEAR(Area(model), 100.0 - 4.0 - 4.0, 1e-9);
  EXPECT_EQ(model.feature_edges.size(), 12u);
}

TEST(ReadCityGml, OutlineAndHoleThatChangedPlacesAreExchanged) {
  const auto p = [](double x, double y) { return Vector3d(kCorner + Vector3d(x, y, 5)); };
  const Ring outer{p(0, 0), p(10, 0), p(10, 10), p(0, 10)};
  const Ring hole{p(4, 4), p(6, 4), p(6, 6), p(4, 6)};
  const CityModel model =
      ReadGml(GmlDocument(GmlBuilding("a", GmlBoundary("RoofSurface", GmlPolygon(hole, {outer})))));
  EXPECT_NEAR(Area(model), 96.0, 1e-9);
  EXPECT_GT(model.surfaces[0].normal.z(), 0.9f);
  EXPECT_TRUE(Warns(model, "hole was larger than their outline, exchanged (a)"));
}

TEST(ReadCityGml, BuildingPartsAreBuildingsWithAParent) {
  const std::string part = "<bldg:consistsOfBuildingPart><bldg:BuildingPart gml:id=\"p\">" +
                           BoxSolid(kCorner, kCorner + kSize) +
                           "</bldg:BuildingPart></bldg:consistsOfBuildingPart>";
  const CityModel model = ReadGml(GmlDocument(GmlBuilding("whole", part)));
  ExpectBox(model);
  ASSERT_EQ(model.buildings.size(), 1u);
  EXPECT_EQ(model.buildings[0].id, "p");
  EXPECT_EQ(model.buildings[0].parent_id, "whole");
  EXPECT_TRUE(model.warnings.empty());
}

TEST(ReadCityGml, WantedLevelOfDetailIsChosen) {
  const std::string both = BoxSolid(kCorner, kCorner + Vector3d(10, 8, 3), 1) +
                           BoxSolid(kCorner, kCorner + kSize, 2) +
                           BoxSolid(kCorner, kCorner + Vector3d(10, 8, 9), 3);
  const std::string text = GmlDocument(GmlBuilding("a", both));
  EXPECT_NEAR(Volume(ReadGml(text)), 480.0, 1e-6);
  CityOptions options;
  options.lod = 1;
  EXPECT_NEAR(Volume(ReadGml(text, options)), 240.0, 1e-6);
  options.lod = 3;
  EXPECT_NEAR(Volume(ReadGml(text, options)), 720.0, 1e-6);
}

TEST(ReadCityGml, FallsBackToAnotherLevelAndSaysSo) {
  const CityModel lod1 =
      ReadGml(GmlDocument(GmlBuilding("flat", BoxSolid(kCorner, kCorner + kSize, 1))));
  ExpectBox(lod1);
  EXPECT_TRUE(Warns(lod1, "1 buildings read at LoD1 for lack of LoD2 (flat)"));
  const CityModel lod3 = ReadGml(GmlDocument(GmlBuilding(
      "fine",
      BoxSolid(kCorner, kCorner + Vector3d(10, 8, 3), 1) + BoxSolid(kCorner, kCorner + kSize, 3))));
  ExpectBox(lod3);
  EXPECT_TRUE(Warns(lod3, "read at LoD3 for lack of LoD2 (fine)"));
}

TEST(ReadCityGml, PartsAtTheWantedLevelReplaceTheWholeAtALowerOne) {
  const std::string part = "<bldg:consistsOfBuildingPart><bldg:BuildingPart gml:id=\"p\">" +
                           BoxSolid(kCorner, kCorner + kSize) +
                           "</bldg:BuildingPart></bldg:consistsOfBuildingPart>";
  const CityModel model = ReadGml(
      GmlDocument(GmlBuilding("whole", BoxSolid(kCorner, kCorner + Vector3d(10, 8, 3), 1) + part)));
  ExpectBox(model);
}

TEST(ReadCityGml, BuildingsWithoutVolumeAreNamed) {
  const std::string outline = "<bldg:lod0FootPrint><gml:MultiSurface>" +
                              Member(GmlPolygon(Box()[5])) +
                              "</gml:MultiSurface></bldg:lod0FootPrint>";
  const CityModel model =
      ReadGml(GmlDocument(GmlBuilding("outline", outline) + GmlBuilding("bare", "") +
                          GmlBox("house", kCorner, kCorner + kSize)));
  EXPECT_EQ(model.buildings.size(), 1u);
  EXPECT_TRUE(Warns(model, "1 buildings with an outline (LoD0) only dropped (outline)"));
  EXPECT_TRUE(Warns(model, "1 buildings without geometry dropped (bare)"));
}

TEST(ReadCityGml, ReversedSurfaceIsTurnedAround) {
  // A lone wall as seen from inside, used with orientation "-".
  Ring ring = Box()[0];
  std::reverse(ring.begin(), ring.end());
  const std::string oriented = "<gml:OrientableSurface orientation=\"-\"><gml:baseSurface>" +
                               GmlPolygon(ring) + "</gml:baseSurface></gml:OrientableSurface>";
  const CityModel model =
      ReadGml(GmlDocument(GmlBuilding("a", GmlBoundary("WallSurface", oriented))));
  ASSERT_EQ(model.surfaces.size(), 1u);
  EXPECT_NEAR(model.surfaces[0].normal.y(), -1.0, 1e-6);
}

TEST(ReadCityGml, FlippedPolygonIsTurnedOutwards) {
  std::vector<Ring> rings = Box();
  std::reverse(rings[2].begin(), rings[2].end());
  std::string members;
  for (const Ring& ring : rings) members += Member(GmlPolygon(ring));
  const CityModel one = ReadGml(GmlDocument(GmlBuilding("a", Solid(members))));
  ExpectBox(one);
  EXPECT_TRUE(Warns(one, "1 buildings with surfaces turned outwards (a)"));
  members.clear();
  for (Ring ring : Box()) {
    std::reverse(ring.begin(), ring.end());
    members += Member(GmlPolygon(ring));
  }
  ExpectBox(ReadGml(GmlDocument(GmlBuilding("a", Solid(members)))));
}

TEST(ReadCityGml, ImplicitGeometryIsMovedToItsPlace) {
  const std::string matrix = "0 -1 0 5  1 0 0 0  0 0 1 0  0 0 0 1";
  const std::string point = std::to_string(kCorner.x()) + " " + std::to_string(kCorner.y()) + " " +
                            std::to_string(kCorner.z());
  const auto implicit = [&](const std::string& geometry) {
    return "<bldg:outerBuildingInstallation><bldg:BuildingInstallation>"
           "<bldg:lod2ImplicitRepresentation><core:ImplicitGeometry><core:transformationMatrix>" +
           matrix + "</core:transformationMatrix>" + geometry +
           "<core:referencePoint><gml:Point><gml:pos>" + point +
           "</gml:pos></gml:Point></core:referencePoint></core:ImplicitGeometry>"
           "</bldg:lod2ImplicitRepresentation></bldg:BuildingInstallation>"
           "</bldg:outerBuildingInstallation>";
  };
  const Ring triangle{{0, 0, 1}, {2, 0, 1}, {0, 1, 1}};
  const std::string inline_geometry =
      "<core:relativeGMLGeometry><gml:MultiSurface gml:id=\"proto\">" +
      Member(GmlPolygon(triangle)) + "</gml:MultiSurface></core:relativeGMLGeometry>";
  const std::string linked = "<core:relativeGMLGeometry xlink:href=\"#proto\"/>";
  const CityModel model = ReadGml(GmlDocument(GmlBuilding("a", implicit(inline_geometry)) +
                                              GmlBuilding("b", implicit(linked))));
  ASSERT_EQ(model.buildings.size(), 2u);
  ASSERT_EQ(model.triangles.size(), 2u);
  EXPECT_NEAR(Area(model), 2.0, 1e-6);
  for (const Vector3d& expected : {Vector3d(5, 0, 1), Vector3d(5, 2, 1), Vector3d(4, 0, 1)}) {
    const bool found =
        std::any_of(model.vertices.begin(), model.vertices.end(), [&](const auto& v) {
          return (v + model.origin_in_world - kCorner - expected).norm() < 1e-5;
        });
    EXPECT_TRUE(found) << expected.transpose();
  }
}

TEST(ReadCityGml, InteriorsAreNotRead) {
  const std::string room = "<bldg:interiorRoom><bldg:Room>" +
                           BoxSolid(kCorner + Vector3d(1, 1, 1), kCorner + Vector3d(2, 2, 2)) +
                           "</bldg:Room></bldg:interiorRoom>";
  ExpectBox(ReadGml(GmlDocument(GmlBuilding("a", BoxSolid(kCorner, kCorner + kSize) + room))));
}

TEST(ReadCityGml, OpeningsCloseTheirWalls) {
  const auto p = [](double x, double z) { return Vector3d(kCorner + Vector3d(x, 0, z)); };
  const Ring wall{p(0, 0), p(10, 0), p(10, 6), p(0, 6)};
  const Ring hole{p(4, 2), p(4, 4), p(6, 4), p(6, 2)};
  const Ring window{p(4, 2), p(6, 2), p(6, 4), p(4, 4)};
  const std::string content =
      "<bldg:boundedBy><bldg:WallSurface><bldg:lod3MultiSurface><gml:MultiSurface>" +
      Member(GmlPolygon(wall, {hole})) +
      "</gml:MultiSurface></bldg:lod3MultiSurface><bldg:opening><bldg:Window>"
      "<bldg:lod3MultiSurface><gml:MultiSurface>" +
      Member(GmlPolygon(window)) +
      "</gml:MultiSurface></bldg:lod3MultiSurface></bldg:Window></bldg:opening>"
      "</bldg:WallSurface></bldg:boundedBy>";
  const CityModel model = ReadGml(GmlDocument(GmlBuilding("a", content)));
  EXPECT_NEAR(Area(model, SurfaceClass::kWall), 60.0, 1e-9);
  EXPECT_EQ(model.feature_edges.size(), 4u);
}

TEST(ReadCityGml, OtherCityObjectsAreCounted) {
  const CityModel model = ReadGml(
      GmlDocument("<core:cityObjectMember><brid:Bridge xmlns:brid=\"b\"/></core:cityObjectMember>" +
                  GmlBox("a", kCorner, kCorner + kSize)));
  EXPECT_TRUE(Warns(model, "1 Bridge objects (not buildings) passed over"));
}

TEST(ReadCityGml, CoordinatesMayBeSinglePositionsOrOldStyle) {
  const auto polygon = [](const std::string& content) {
    return GmlBuilding("a",
                       GmlBoundary("RoofSurface",
                                   "<gml:Polygon><gml:exterior><gml:LinearRing>" + content +
                                       "</gml:LinearRing></gml:exterior></gml:Polygon>"));
  };
  const std::string pos =
      "<gml:pos>0 0 5</gml:pos><gml:pos>4 0 5</gml:pos><gml:pos>4 3 5</gml:pos>"
      "<gml:pos>0 0 5</gml:pos>";
  EXPECT_NEAR(Area(ReadGml(GmlDocument(polygon(pos), ""))), 6.0, 1e-12);
  const std::string old = "<gml:coordinates>0,0,5 4,0,5 4,3,5 0,0,5</gml:coordinates>";
  EXPECT_NEAR(Area(ReadGml(GmlDocument(polygon(old), ""))), 6.0, 1e-12);
  const std::string exponents = "<gml:posList>0 0 5e0\n+4 0 .5E1\t4.0 3 5. 0 0 5</gml:posList>";
  EXPECT_NEAR(Area(ReadGml(GmlDocument(polygon(exponents), ""))), 6.0, 1e-12);
}

TEST(ReadCityGml, OldCoordinatesSayWhatSeparatesThem) {
  const auto area = [](const std::string& content) {
    return Area(ReadGml(GmlDocument(
        GmlBuilding("a",
                    GmlBoundary("RoofSurface",
                                "<gml:Polygon><gml:exterior><gml:LinearRing>" + content +
                                    "</gml:LinearRing></gml:exterior></gml:Polygon>")),
        "")));
  };
  EXPECT_NEAR(area("<gml:coordinates decimal=\",\" cs=\";\" ts=\"|\">0;0;5|4,5;0;5|4,5;3;5|0;0;5"
                   "</gml:coordinates>"),
              6.75,
              1e-12);
  const auto coord = [](const std::string& x, const std::string& y) {
    return "<gml:coord><gml:X>" + x + "</gml:X><gml:Y>" + y +
           "</gml:Y><gml:Z>5</gml:Z></gml:coord>";
  };
  EXPECT_NEAR(
      area(coord("0", "0") + coord("4.5", "0") + coord("4.5", "3") + coord("0", "0")), 6.75, 1e-12);
}

// Two numbers would put it at 0, 0, 0.
TEST(ReadCityGml, ImplicitGeometryWithoutItsPlaceIsNamed) {
  const std::string implicit =
      "<bldg:outerBuildingInstallation><bldg:BuildingInstallation>"
      "<bldg:lod2ImplicitRepresentation><core:ImplicitGeometry><core:relativeGMLGeometry>" +
      GmlPolygon({{0, 0, 1}, {2, 0, 1}, {0, 1, 1}}) +
      "</core:relativeGMLGeometry><core:referencePoint><gml:Point><gml:pos>691000 5336000"
      "</gml:pos></gml:Point></core:referencePoint></core:ImplicitGeometry>"
      "</bldg:lod2ImplicitRepresentation></bldg:BuildingInstallation>"
      "</bldg:outerBuildingInstallation>";
  const CityModel model =
      ReadGml(GmlDocument(GmlBox("b", kCorner, kCorner + kSize) + GmlBuilding("a", implicit)));
  ExpectBox(model);
  EXPECT_TRUE(
      Warns(model, "1 implicit geometries without a place of three coordinates dropped (a)"));
}

TEST(ReadCityGml, BuildingsWithoutIdAreNumbered) {
  const CityModel model = ReadGml(GmlDocument(GmlBox("", kCorner, kCorner + kSize)));
  EXPECT_EQ(model.buildings[0].id, "building-1");
}

TEST(ReadCityGml, VersionThreeNamesAreKnown) {
  std::string text = GmlDocument(GmlBox("a", kCorner, kCorner + kSize));
  const auto replace = [&text](const std::string& from, const std::string& to) {
    for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size()) {
      text.replace(at, from.size(), to);
    }
  };
  replace("bldg:boundedBy", "core:boundary");
  replace("/2.0", "/3.0");
  replace("bldg:lod2MultiSurface", "core:lod2MultiSurface");
  replace("bldg:WallSurface", "con:WallSurface");
  replace("xmlns:xlink",
          "xmlns:con=\"http://www.opengis.net/citygml/construction/3.0\" xmlns:xlink");
  ExpectBox(ReadGml(text));
}

TEST(ReadCityGml, CoordinatesInPairsAreNotReadAsTriples) {
  // Six numbers in a row read as two triples; the ring shows that they are pairs.
  const std::string flat =
      "<gml:Polygon><gml:exterior><gml:LinearRing><gml:posList>1 2 5 2 5 6 3 4 1 7 1 2"
      "</gml:posList></gml:LinearRing></gml:exterior></gml:Polygon>";
  const CityModel model =
      ReadGml(GmlDocument(GmlBuilding("flat", GmlBoundary("RoofSurface", flat)) +
                          GmlBox("a", kCorner, kCorner + kSize)));
  EXPECT_EQ(model.buildings.size(), 1u);
  EXPECT_TRUE(Warns(model, "1 polygons without heights (coordinates in pairs) dropped (flat)"));
}

TEST(ReadCityGml, SeveralFilesMakeOneModel) {
  const TestFolder folder;
  folder.Write("tiles/a.gml", GmlDocument(GmlBox("a", kCorner, kCorner + kSize)));
  folder.Write("tiles/b.gml",
               GmlDocument(GmlBox("b", kCorner + Vector3d(10, 0, 0), kCorner + Vector3d(20, 8, 6)) +
                           GmlBox("a", kCorner, kCorner + kSize)));
  folder.Write("tiles/notes.xml", "<notes/>");
  const CityModel model = ReadCity({folder.path() / "tiles"}, {});
  EXPECT_EQ(model.buildings.size(), 2u);
  EXPECT_EQ(model.surfaces.size(), 12u);
  EXPECT_TRUE(Warns(model, "1 buildings that an earlier file holds too, taken once (a)"));
  EXPECT_NEAR(Volume(model), 2.0 * kSize.prod(), 1e-6);
}

TEST(ReadCityGml, EqualIdsInDifferentPlacesAreTwoBuildings) {
  const TestFolder folder;
  const auto a = folder.Write("a.gml", GmlDocument(GmlBox("1", kCorner, kCorner + kSize)));
  const Vector3d aside(100, 0, 0);
  const auto b =
      folder.Write("b.gml", GmlDocument(GmlBox("1", kCorner + aside, kCorner + aside + kSize)));
  EXPECT_EQ(ReadCity({a, b}, {}).buildings.size(), 2u);
}

TEST(ReadCityGml, ModelMovedFarAwayKeepsItsShape) {
  const Vector3d far(5e6, -4e6, 0);
  const CityModel near_model = ReadGml(GmlDocument(GmlBox("a", kCorner, kCorner + kSize)));
  CityOptions options;
  options.model_crs = "EPSG:25832";
  const CityModel far_model =
      ReadGml(GmlDocument(GmlBox("a", kCorner + far, kCorner + far + kSize)), options);
  EXPECT_EQ(far_model.origin_in_world - near_model.origin_in_world, far);
  ASSERT_EQ(near_model.vertices.size(), far_model.vertices.size());
  for (std::size_t i = 0; i < near_model.vertices.size(); ++i) {
    EXPECT_NEAR((near_model.vertices[i] - far_model.vertices[i]).norm(), 0.0, 1e-6);
  }
}

}  // namespace
}  // namespace ridgeline::testing
