// SPDX-License-Identifier: Apache-2.0
#include "city/format/citygml_tags.h"

#include <unordered_map>

namespace ridgeline {
namespace {

const std::unordered_map<std::string_view, GmlElement>& Elements() {
  using enum GmlTag;
  constexpr auto kClassless = SurfaceClass::kOther;
  static const std::unordered_map<std::string_view, GmlElement> elements = {
      {"cityObjectMember", {kMember, kClassless, false, -1}},
      {"featureMember", {kMember, kClassless, false, -1}},
      {"Building", {kBuilding, kClassless, false, -1}},
      {"BuildingPart", {kBuilding, kClassless, false, -1}},
      {"BuildingUnit", {kBuilding, kClassless, false, -1}},
      {"Storey", {kBuilding, kClassless, false, -1}},
      {"WallSurface", {kBoundary, SurfaceClass::kWall, true, -1}},
      {"RoofSurface", {kBoundary, SurfaceClass::kRoof, true, -1}},
      {"GroundSurface", {kBoundary, SurfaceClass::kGround, true, -1}},
      {"ClosureSurface", {kBoundary, SurfaceClass::kClosure, true, -1}},
      {"OuterFloorSurface", {kBoundary, kClassless, false, -1}},
      {"OuterCeilingSurface", {kBoundary, SurfaceClass::kOther, true, -1}},
      {"Window", {kOpening, SurfaceClass::kWall, false, -1}},
      {"Door", {kOpening, SurfaceClass::kWall, false, -1}},
      {"WindowSurface", {kOpening, SurfaceClass::kWall, false, -1}},
      {"DoorSurface", {kOpening, SurfaceClass::kWall, false, -1}},
      {"BuildingInstallation", {kInstallation, kClassless, true, -1}},
      {"BuildingConstructiveElement", {kInstallation, kClassless, true, -1}},
      {"Room", {kSkipped, kClassless, false, -1}},
      {"BuildingRoom", {kSkipped, kClassless, false, -1}},
      {"interiorRoom", {kSkipped, kClassless, false, -1}},
      {"buildingRoom", {kSkipped, kClassless, false, -1}},
      {"IntBuildingInstallation", {kSkipped, kClassless, false, -1}},
      {"interiorBuildingInstallation", {kSkipped, kClassless, false, -1}},
      {"BuildingFurniture", {kSkipped, kClassless, false, -1}},
      {"buildingFurniture", {kSkipped, kClassless, false, -1}},
      {"InteriorWallSurface", {kSkipped, kClassless, false, -1}},
      {"FloorSurface", {kSkipped, kClassless, false, -1}},
      {"CeilingSurface", {kSkipped, kClassless, false, -1}},
      {"appearance", {kSkipped, kClassless, false, -1}},
      {"appearanceMember", {kSkipped, kClassless, false, -1}},
      {"externalReference", {kSkipped, kClassless, false, -1}},
      {"address", {kSkipped, kClassless, false, -1}},
      {"stringAttribute", {kSkipped, kClassless, false, -1}},
      {"genericAttribute", {kSkipped, kClassless, false, -1}},
      {"genericAttributeSet", {kSkipped, kClassless, false, -1}},
      {"Solid", {kSolid, kClassless, false, -1}},
      {"CompositeSolid", {kAggregate, kClassless, false, -1}},
      {"MultiSolid", {kAggregate, kClassless, false, -1}},
      {"MultiSurface", {kAggregate, kClassless, false, -1}},
      {"CompositeSurface", {kAggregate, kClassless, false, -1}},
      {"Surface", {kAggregate, kClassless, false, -1}},
      {"PolyhedralSurface", {kAggregate, kClassless, false, -1}},
      {"TriangulatedSurface", {kAggregate, kClassless, false, -1}},
      {"Tin", {kAggregate, kClassless, false, -1}},
      {"Shell", {kAggregate, kClassless, false, -1}},
      {"MultiGeometry", {kAggregate, kClassless, false, -1}},
      {"OrientableSurface", {kOrientable, kClassless, false, -1}},
      {"Polygon", {kPolygon, kClassless, false, -1}},
      {"PolygonPatch", {kPolygon, kClassless, false, -1}},
      {"Triangle", {kPolygon, kClassless, false, -1}},
      {"Rectangle", {kPolygon, kClassless, false, -1}},
      {"exterior", {kExterior, kClassless, false, -1}},
      {"outerBoundaryIs", {kExterior, kClassless, false, -1}},
      {"interior", {kInterior, kClassless, false, -1}},
      {"innerBoundaryIs", {kInterior, kClassless, false, -1}},
      {"LinearRing", {kRing, kClassless, false, -1}},
      {"Ring", {kRing, kClassless, false, -1}},
      {"posList", {kCoordinates, kClassless, false, -1}},
      {"pos", {kCoordinates, kClassless, false, -1}},
      {"X", {kCoordinates, kClassless, false, -1}},
      {"Y", {kCoordinates, kClassless, false, -1}},
      {"Z", {kCoordinates, kClassless, false, -1}},
      {"coordinates", {kTuples, kClassless, false, -1}},
      {"ImplicitGeometry", {kImplicit, kClassless, false, -1}},
      {"transformationMatrix", {kMatrix, kClassless, false, -1}},
      {"referencePoint", {kReferencePoint, kClassless, false, -1}},
      {"relativeGMLGeometry", {kPrototype, kClassless, false, -1}},
      {"relativeGeometry", {kPrototype, kClassless, false, -1}},
      {"libraryObject", {kLibraryObject, kClassless, false, -1}},
  };
  return elements;
}

// lod2Solid, lod0FootPrint, lod3TerrainIntersection, ...
GmlElement LodElement(std::string_view name) {
  const bool is_lod =
      name.size() > 4 && name.starts_with("lod") && name[3] >= '0' && name[3] <= '4';
  if (!is_lod) return {};
  const std::string_view kind = name.substr(4);
  if (kind == "TerrainIntersection" || kind == "TerrainIntersectionCurve" || kind == "MultiCurve" ||
      kind == "Point") {
    return {GmlTag::kSkipped, SurfaceClass::kOther, false, -1};
  }
  return {GmlTag::kLod, SurfaceClass::kOther, false, static_cast<std::int8_t>(name[3] - '0')};
}

}  // namespace

GmlElement FindGmlElement(std::string_view local_name) {
  const auto it = Elements().find(local_name);
  return it != Elements().end() ? it->second : LodElement(local_name);
}

std::string_view CityGmlVersion(std::string_view uri) {
  if (uri.find("opengis.net/citygml") == std::string_view::npos) return {};
  if (uri.ends_with("/1.0")) return "CityGML 1.0";
  if (uri.ends_with("/2.0")) return "CityGML 2.0";
  if (uri.ends_with("/3.0")) return "CityGML 3.0";
  return {};
}

}  // namespace ridgeline
