// SPDX-License-Identifier: Apache-2.0
#include <cstdio>
#include <string>

#include "base/atomic_file.h"
#include "synth/building_shape.h"
#include "synth/write_city.h"

namespace ridgeline {
namespace {

using Eigen::Vector3d;

constexpr const char* kHeader =
    R"(<?xml version="1.0" encoding="UTF-8"?>
<core:CityModel xmlns:core="http://www.opengis.net/citygml/2.0" xmlns:bldg="http://www.opengis.net/citygml/building/2.0" xmlns:gml="http://www.opengis.net/gml" xmlns:xlink="http://www.w3.org/1999/xlink" xmlns:xsi="http://www.w3.org/2001/XMLSchema-instance" xsi:schemaLocation="http://www.opengis.net/citygml/building/2.0 http://schemas.opengis.net/citygml/building/2.0/building.xsd">
)";

// AdV code list of roof types.
const char* RoofCode(RoofType roof) {
  switch (roof) {
    case RoofType::kFlat:
      return "1000";
    case RoofType::kShed:
      return "2100";
    case RoofType::kGable:
      return "3100";
    case RoofType::kHip:
      return "3200";
    case RoofType::kPyramid:
      return "3500";
  }
  return "9999";
}

const char* SurfaceName(SurfaceClass surface_class) {
  switch (surface_class) {
    case SurfaceClass::kWall:
      return "WallSurface";
    case SurfaceClass::kRoof:
      return "RoofSurface";
    default:
      return "GroundSurface";
  }
}

class Writer {
 public:
  explicit Writer(const Town& town) : town_(town) {}

  std::string Write() {
    out_ = kHeader;
    out_ += "<gml:description>An invented town; ridgeline synth, seed " +
            std::to_string(town_.options.seed) + "</gml:description>\n";
    Envelope();
    for (std::size_t i = 0; i < town_.buildings.size(); ++i) {
      if (town_.buildings[i].parent < 0) WriteBuilding(i);
    }
    out_ += "</core:CityModel>\n";
    return std::move(out_);
  }

 private:
  std::string Coordinates(const Vector3d& local) const {
    const Vector3d world = town_.origin_in_world + local;
    char text[96];
    std::snprintf(text, sizeof text, "%.4f %.4f %.4f", world.x(), world.y(), world.z());
    return text;
  }

  void Envelope() {
    Vector3d lower = Vector3d::Constant(1e300);
    Vector3d upper = Vector3d::Constant(-1e300);
    for (const TownBuilding& b : town_.buildings) {
      for (const Eigen::Vector2d& corner : b.Footprint()) {
        lower = lower.cwiseMin(Vector3d(corner.x(), corner.y(), b.base_m));
        upper = upper.cwiseMax(Vector3d(corner.x(), corner.y(), b.ridge_m));
      }
    }
    out_ +=
        "<gml:boundedBy><gml:Envelope srsName=\"urn:adv:crs:ETRS89_UTM32*DE_DHHN2016_NH\" "
        "srsDimension=\"3\"><gml:lowerCorner>" +
        Coordinates(lower) + "</gml:lowerCorner><gml:upperCorner>" + Coordinates(upper) +
        "</gml:upperCorner></gml:Envelope></gml:boundedBy>\n";
  }

  void WriteBuilding(std::size_t index) {
    const TownBuilding& building = town_.buildings[index];
    out_ += "<core:cityObjectMember>\n<bldg:Building gml:id=\"" + building.id + "\">\n";
    out_ +=
        "<core:creationDate>2024-01-01</core:creationDate>\n"
        "<core:externalReference><core:informationSystem>"
        "http://repository.gdi-de.org/schemas/adv/citygml/fdv/art.htm#_9100"
        "</core:informationSystem><core:externalObject><core:name>" +
        building.id + "</core:name></core:externalObject></core:externalReference>\n";
    WriteGeometry(building);
    for (const TownBuilding& part : town_.buildings) {
      if (part.parent != static_cast<int>(index)) continue;
      out_ += "<bldg:consistsOfBuildingPart>\n<bldg:BuildingPart gml:id=\"" + part.id + "\">\n";
      WriteGeometry(part);
      out_ += "</bldg:BuildingPart>\n</bldg:consistsOfBuildingPart>\n";
    }
    out_ += "</bldg:Building>\n</core:cityObjectMember>\n";
  }

  // Attributes, the solid that refers to its polygons, and the boundary surfaces that hold them, in
  // the order of the schema.
  void WriteGeometry(const TownBuilding& building) {
    const auto solid = LodTwoSolid(building);
    char height[32];
    std::snprintf(height, sizeof height, "%.3f", building.ridge_m - building.base_m);
    out_ += "<bldg:function>31001_1010</bldg:function>\n<bldg:roofType>" +
            std::string(RoofCode(building.roof)) +
            "</bldg:roofType>\n<bldg:measuredHeight uom=\"urn:adv:uom:m\">" + height +
            "</bldg:measuredHeight>\n<bldg:storeysAboveGround>" + std::to_string(building.storeys) +
            "</bldg:storeysAboveGround>\n<bldg:lod2Solid><gml:Solid><gml:exterior>"
            "<gml:CompositeSurface>\n";
    for (std::size_t k = 0; k < solid.size(); ++k) {
      out_ += "<gml:surfaceMember xlink:href=\"#" + PolygonId(building, k) + "\"/>\n";
    }
    out_ += "</gml:CompositeSurface></gml:exterior></gml:Solid></bldg:lod2Solid>\n";
    for (std::size_t k = 0; k < solid.size(); ++k) {
      WriteSurface(solid[k], PolygonId(building, k));
    }
  }

  static std::string PolygonId(const TownBuilding& building, std::size_t k) {
    return building.id + "_p" + std::to_string(k);
  }

  void WriteSurface(const ShapePolygon& polygon, const std::string& id) {
    const std::string name = SurfaceName(polygon.surface_class);
    out_ += "<bldg:boundedBy><bldg:" + name +
            "><bldg:lod2MultiSurface><gml:MultiSurface><gml:surfaceMember><gml:Polygon gml:id=\"" +
            id + "\"><gml:exterior><gml:LinearRing><gml:posList>";
    for (const Vector3d& p : polygon.ring) out_ += Coordinates(p) + " ";
    out_ += Coordinates(polygon.ring.front()) +
            "</gml:posList></gml:LinearRing></gml:exterior></gml:Polygon></gml:surfaceMember>"
            "</gml:MultiSurface></bldg:lod2MultiSurface></bldg:" +
            name + "></bldg:boundedBy>\n";
  }

  const Town& town_;
  std::string out_;
};

}  // namespace

void WriteCityGml(const Town& town, const std::filesystem::path& path) {
  WriteFileAtomically(path, Writer(town).Write());
}

}  // namespace ridgeline
