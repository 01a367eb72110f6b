// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string_view>

#include "city/city_model.h"

namespace ridgeline {

// What an element of CityGML 1.0 to 3.0 means to the reader. The versions differ in namespaces and
// in a few names, so that local names decide.
enum class GmlTag : std::uint8_t {
  kOther,
  kMember,        // cityObjectMember, featureMember
  kBuilding,      // Building, BuildingPart and the subdivisions of CityGML 3.0
  kBoundary,      // WallSurface, RoofSurface, ...
  kOpening,       // Window, Door, WindowSurface, DoorSurface
  kInstallation,  // BuildingInstallation, BuildingConstructiveElement
  kSkipped,       // interiors, appearances, attributes, terrain intersections, curves
  kLod,           // lod2Solid, lod2MultiSurface, ...
  kSolid,
  kAggregate,  // MultiSurface, CompositeSurface, Surface, TriangulatedSurface, Shell, ...
  kOrientable,
  kPolygon,  // Polygon, PolygonPatch, Triangle, Rectangle
  kExterior,
  kInterior,
  kRing,         // LinearRing, Ring
  kCoordinates,  // posList, pos, X, Y, Z
  kTuples,       // coordinates, as in GML 2
  kImplicit,
  kMatrix,
  kReferencePoint,
  kPrototype,  // relativeGMLGeometry, relativeGeometry
  kLibraryObject,
};

struct GmlElement {
  GmlTag tag = GmlTag::kOther;
  SurfaceClass surface_class = SurfaceClass::kOther;  // of kBoundary and kOpening
  bool has_class = false;                             // false: the normal decides
  std::int8_t lod = -1;                               // of kLod
};

// Looks an element up by its local name.
GmlElement FindGmlElement(std::string_view local_name);

// "CityGML 2.0" from a namespace URI; empty if it is none.
std::string_view CityGmlVersion(std::string_view namespace_uri);

}  // namespace ridgeline
