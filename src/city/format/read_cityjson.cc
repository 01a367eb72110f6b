// SPDX-License-Identifier: Apache-2.0
#include "city/format/read_cityjson.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <string>
#include <unordered_map>
#include <vector>

#include "base/error.h"
#include "base/json_input.h"
#include "base/limits.h"

namespace ridgeline {
namespace {

using Json = nlohmann::json;

struct SurfaceKind {
  SurfaceClass surface_class = SurfaceClass::kOther;
  bool has_class = false;
  bool interior = false;
};

SurfaceKind KindOf(const std::string& type) {
  if (type == "WallSurface") return {SurfaceClass::kWall, true, false};
  if (type == "RoofSurface") return {SurfaceClass::kRoof, true, false};
  if (type == "GroundSurface") return {SurfaceClass::kGround, true, false};
  if (type == "ClosureSurface") return {SurfaceClass::kClosure, true, false};
  if (type == "OuterCeilingSurface") return {SurfaceClass::kOther, true, false};
  const bool interior =
      type == "InteriorWallSurface" || type == "CeilingSurface" || type == "FloorSurface";
  return {SurfaceClass::kOther, false, interior};
}

bool IsBuilding(const std::string& type) {
  static const std::set<std::string> types = {
      "Building", "BuildingPart", "BuildingUnit", "BuildingStorey"};
  return types.contains(type);
}

bool IsInstallation(const std::string& type) {
  return type == "BuildingInstallation" || type == "BuildingConstructiveElement";
}

// "2.2" and 2 both start with the level; NaN-proof.
double LodOf(const Json& geometry) {
  const auto it = geometry.find("lod");
  if (it == geometry.end()) return -1.0;
  if (it->is_number()) return it->get<double>();
  try {
    return it->is_string() ? std::stod(it->get<std::string>()) : -1.0;
  } catch (const std::exception&) {
    return -1.0;
  }
}

// The integer level; -1: none that is known.
int LevelOf(double lod) { return lod >= 0.0 && lod < 5.0 ? static_cast<int>(lod) : -1; }

bool IsSurfaceList(const std::string& type) {
  return type == "MultiSurface" || type == "CompositeSurface";
}

bool HasSurfaces(const Json& shape) {
  const std::string type = shape.value("type", "");
  return IsSurfaceList(type) || type == "Solid" || type == "MultiSolid" || type == "CompositeSolid";
}

std::size_t PolygonsIn(const Json& shape) {
  const std::string type = shape.value("type", "");
  const Json& boundaries = shape.at("boundaries");
  if (IsSurfaceList(type)) return boundaries.size();
  std::size_t count = 0;
  for (const Json& part : boundaries) {  // shells, or solids of shells
    if (type == "Solid") {
      count += part.size();
    } else {
      for (const Json& shell : part) count += shell.size();
    }
  }
  return count;
}

class CityJsonReader {
 public:
  explicit CityJsonReader(SourceModel& model) : model_(model) {}

  // Where reading has come to: a line of a sequence, an object, a geometry of it; may be empty.
  const std::string& place() const { return place_; }
  void BeginLine(std::size_t number) { place_ = "line " + std::to_string(number); }

  void ReadHeader(const Json& root) {
    const std::string type = root.value("type", "");
    if (type != "CityJSON") {
      throw InputError(model_.file, "type", "\"" + type + "\"", "\"CityJSON\"");
    }
    const std::string version = root.value("version", "");
    if (!version.starts_with("1.") && !version.starts_with("2.")) {
      throw InputError(model_.file, "version", "\"" + version + "\"", "1.0, 1.1 or 2.0");
    }
    model_.format = "CityJSON " + version;
    if (const auto it = root.find("transform"); it != root.end()) {
      scale_ = Vector(it->at("scale"), "transform.scale");
      translate_ = Vector(it->at("translate"), "transform.translate");
    }
    if (const auto it = root.find("metadata"); it != root.end() && it->is_object()) {
      const std::string crs = it->value("referenceSystem", "");
      if (!crs.empty()) model_.srs_names.push_back(crs);
    }
    if (const auto it = root.find("geometry-templates"); it != root.end()) {
      templates_ = it->at("templates");
      for (const Json& v : it->at("vertices-templates")) {
        template_vertices_.push_back(Vector(v, "geometry-templates.vertices-templates"));
      }
    }
  }

  // The city objects of a CityJSON document or of one feature.
  void ReadObjects(const Json& root) {
    vertices_.clear();
    if (const auto it = root.find("vertices"); it != root.end()) {
      vertices_.reserve(it->size());
      for (const Json& v : *it) {
        vertices_.push_back(Vector(v, "vertices").cwiseProduct(scale_) + translate_);
      }
    }
    const Json& objects = root.at("CityObjects");
    std::unordered_map<std::string, int> index;
    for (const auto& [id, object] : objects.items()) {
      place_ = "CityObjects." + id;
      const std::string type = object.value("type", "");
      if (IsBuilding(type)) {
        index.emplace(id, static_cast<int>(model_.buildings.size()));
        model_.buildings.push_back({id, -1, {}});
      } else if (!IsInstallation(type)) {
        model_.tally.Add(type + " objects (not buildings) passed over", std::size_t{1});
      }
    }
    for (const auto& [id, object] : objects.items()) {
      place_ = "CityObjects." + id;
      int owner = -1;
      const auto own = index.find(id);
      const int parent = ParentOf(object, index);
      if (own != index.end()) {
        owner = own->second;
        model_.buildings[static_cast<std::size_t>(owner)].parent = parent;
      } else if (IsInstallation(object.value("type", ""))) {
        owner = parent;
        if (owner < 0) model_.tally.Add("installations without a building dropped", id);
      }
      if (owner >= 0) ReadGeometries(id, object, owner, own == index.end());
    }
    for (const auto& [id, b] : index) CheckParents(id, b);
  }

 private:
  [[noreturn]] void Fail(const std::string& what, const std::string& expected) const {
    throw InputError(model_.file, place_, what, expected);
  }

  Eigen::Vector3d Vector(const Json& json, const char* field) const {
    if (!json.is_array() || json.size() < 3 || !json[0].is_number() || !json[1].is_number() ||
        !json[2].is_number()) {
      throw InputError(model_.file, field, JsonText(json), "three numbers");
    }
    return {json[0].get<double>(), json[1].get<double>(), json[2].get<double>()};
  }

  // Parts of parts end somewhere.
  void CheckParents(const std::string& id, int building) const {
    int generations = 0;
    for (int b = building; b >= 0; b = model_.buildings[static_cast<std::size_t>(b)].parent) {
      if (++generations <= limits::kGenerations) continue;
      throw InputError(model_.file,
                       "limit",
                       "more than " + std::to_string(limits::kGenerations) + " parents above " + id,
                       "parts of buildings, not in a circle");
    }
  }

  static int ParentOf(const Json& object, const std::unordered_map<std::string, int>& index) {
    const auto it = object.find("parents");
    if (it == object.end() || !it->is_array()) return -1;
    for (const Json& parent : *it) {
      const auto found = parent.is_string() ? index.find(parent.get<std::string>()) : index.end();
      if (found != index.end()) return found->second;
    }
    return -1;
  }

  // What a geometry is drawn from: itself, or the template of an instance.
  const Json& ShapeOf(const Json& geometry) const {
    if (geometry.value("type", "") != "GeometryInstance") return geometry;
    const Json& number = geometry.at("template");
    const std::size_t index = number.is_number_integer() ? number.get<std::size_t>() : SIZE_MAX;
    if (index >= templates_.size()) {
      Fail("template " + JsonText(number),
           "one of the file's " + std::to_string(templates_.size()) + " templates");
    }
    return templates_[index];
  }

  // Templates are written once and drawn many times.
  void SpendCopies(std::size_t points) {
    copied_ += points;
    if (copied_ <= limits::kCopiedPoints) return;
    throw InputError(
        model_.file,
        "limit",
        "templates that stand for more than " + std::to_string(limits::kCopiedPoints) + " points",
        "geometry that is written out, not multiplied by instances");
  }

  // All surfaces of the finest fraction of each integer level are one shape: 3DBAG gives 1.2 and
  // 1.3, other programs the roof in one geometry and the walls in another.
  void ReadGeometries(const std::string& id, const Json& object, int owner, bool installation) {
    const auto it = object.find("geometry");
    if (it == object.end()) return;
    owner_ = static_cast<std::size_t>(owner);
    installation_ = installation;
    const auto place_at = [&](std::size_t g) {
      place_ = "CityObjects." + id + ".geometry[" + std::to_string(g) + "]";
    };
    std::map<int, double> finest;
    std::map<int, std::vector<std::size_t>> geometries_of_level;
    std::vector<double> lods(it->size(), -1.0);
    for (std::size_t g = 0; g < it->size(); ++g) {
      place_at(g);
      const Json& shape = ShapeOf((*it)[g]);
      if (!HasSurfaces(shape)) {
        model_.tally.Add(shape.value("type", "") + " geometries (no surfaces) passed over", Id());
        continue;
      }
      lods[g] = LodOf(shape);
      const int level = LevelOf(lods[g]);
      model_.polygons_of_lod[level].met += PolygonsIn(shape);
      if (level < 0) {
        PassOver("polygons without a level of detail passed over", level, PolygonsIn(shape));
        continue;
      }
      double& best = finest.try_emplace(level, lods[g]).first->second;
      best = std::max(best, lods[g]);
      geometries_of_level[level].push_back(g);
    }
    for (const auto& [level, geometries] : geometries_of_level) {
      for (const std::size_t g : geometries) {
        place_at(g);
        if (lods[g] < finest[level]) {
          PassOver("polygons of a coarser fraction of their level of detail passed over",
                   level,
                   PolygonsIn(ShapeOf((*it)[g])));
        } else {
          ReadGeometry((*it)[g]);
        }
      }
    }
  }

  void ReadGeometry(const Json& geometry) {
    if (geometry.value("type", "") != "GeometryInstance") {
      ReadBoundaries(geometry, vertices_, Eigen::Matrix4d::Identity());
      return;
    }
    const Json& shape = ShapeOf(geometry);
    const Json& numbers = geometry.at("transformationMatrix");
    if (numbers.size() != 16)
      Fail("a transformationMatrix of " + std::to_string(numbers.size()), "16 numbers");
    Eigen::Matrix4d matrix;
    for (int i = 0; i < 16; ++i) matrix(i / 4, i % 4) = numbers[static_cast<std::size_t>(i)];
    const std::uint32_t anchor = geometry.at("boundaries").at(0).get<std::uint32_t>();
    if (anchor >= vertices_.size())
      Fail("vertex " + std::to_string(anchor), "a vertex of the file");
    Eigen::Matrix4d place = Eigen::Matrix4d::Identity();
    place.topRightCorner<3, 1>() = vertices_[anchor];
    const std::size_t points_before = model_.points.size();
    ReadBoundaries(shape, template_vertices_, place * matrix);
    SpendCopies(model_.points.size() - points_before);
  }

  void ReadBoundaries(const Json& geometry,
                      const std::vector<Eigen::Vector3d>& vertices,
                      const Eigen::Matrix4d& transform) {
    lod_ = static_cast<std::int8_t>(LevelOf(LodOf(geometry)));
    from_ = &vertices;
    transform_ = transform;
    kinds_.clear();
    const Json* values = nullptr;
    if (const auto it = geometry.find("semantics"); it != geometry.end() && it->is_object()) {
      for (const Json& s : it->at("surfaces")) kinds_.push_back(KindOf(s.value("type", "")));
      values = &it->at("values");
    }
    const std::string type = geometry.value("type", "");
    const Json& boundaries = geometry.at("boundaries");
    if (IsSurfaceList(type)) {
      ReadSurfaces(boundaries, values);
    } else if (type == "Solid") {
      ReadSolid(boundaries, values);
    } else {  // MultiSolid, CompositeSolid
      for (std::size_t i = 0; i < boundaries.size(); ++i) ReadSolid(boundaries[i], At(values, i));
    }
  }

  // The values of a nested array; null stands for "nothing said" at any depth.
  static const Json* At(const Json* values, std::size_t i) {
    if (values == nullptr || !values->is_array() || i >= values->size()) return nullptr;
    return &(*values)[i];
  }

  void ReadSolid(const Json& shells, const Json* values) {
    for (std::size_t i = 0; i < shells.size(); ++i) {
      if (i == 0) {
        ReadSurfaces(shells[i], At(values, i));
      } else {
        PassOver("polygons of inner shells of solids passed over", lod_, shells[i].size());
      }
    }
  }

  void ReadSurfaces(const Json& surfaces, const Json* values) {
    for (std::size_t i = 0; i < surfaces.size(); ++i) {
      SurfaceKind kind;
      const Json* const value = At(values, i);
      if (value != nullptr && value->is_number_integer()) {
        const auto k = value->get<std::size_t>();
        if (k >= kinds_.size())
          Fail("semantics value " + JsonText(*value), "an index of its surfaces");
        kind = kinds_[k];
      }
      if (kind.interior) {
        PassOver("polygons inside of buildings passed over", lod_, 1);
        continue;
      }
      if (installation_ && !kind.has_class) kind.has_class = true;
      ReadPolygon(surfaces[i], kind);
    }
  }

  void ReadPolygon(const Json& rings, const SurfaceKind& kind) {
    SourcePolygon polygon{static_cast<std::uint32_t>(model_.rings.size()), 0, ""};
    for (std::size_t r = 0; r < rings.size(); ++r) {
      SourceRing ring{static_cast<std::uint32_t>(model_.points.size()), 0};
      for (const Json& v : rings[r]) {
        if (!v.is_number_integer()) Fail("vertex " + JsonText(v), "a whole number");
        const std::size_t index = v.get<std::size_t>();
        if (index >= from_->size()) {
          Fail("vertex " + JsonText(v), "one of " + std::to_string(from_->size()) + " vertices");
        }
        const Eigen::Vector4d moved = transform_ * (*from_)[index].homogeneous();
        model_.points.push_back(moved.head<3>());
        ++ring.point_count;
      }
      if (ring.point_count < 3) {
        model_.points.resize(ring.first_point);
        if (r == 0) {
          PassOver("polygons with fewer than 3 points dropped", lod_, 1);
          return;
        }
        model_.tally.Add("holes with fewer than 3 points dropped", Id());
        continue;
      }
      model_.rings.push_back(ring);
      ++polygon.ring_count;
    }
    if (polygon.ring_count == 0) {
      PassOver("polygons with fewer than 3 points dropped", lod_, 1);
      return;
    }
    ++model_.polygons_of_lod[lod_].read;
    SourceMember member;
    member.polygon = static_cast<std::uint32_t>(model_.polygons.size());
    member.lod = lod_;
    member.surface_class = kind.surface_class;
    member.has_class = kind.has_class;
    model_.polygons.push_back(std::move(polygon));
    model_.buildings[owner_].members.push_back(member);
  }

  void PassOver(const std::string& kind, int lod, std::size_t polygons) {
    for (std::size_t i = 0; i < polygons; ++i) model_.tally.Add(kind, Id());
    model_.polygons_of_lod[lod].named += polygons;
  }

  const std::string& Id() const { return model_.buildings[owner_].id; }

  SourceModel& model_;
  Eigen::Vector3d scale_ = Eigen::Vector3d::Ones();
  Eigen::Vector3d translate_ = Eigen::Vector3d::Zero();
  std::vector<Eigen::Vector3d> vertices_;
  Json templates_ = Json::array();
  std::vector<Eigen::Vector3d> template_vertices_;
  std::size_t copied_ = 0;  // points of instances
  std::string place_;
  // Of the geometry being read:
  std::size_t owner_ = 0;
  bool installation_ = false;
  std::int8_t lod_ = 0;
  const std::vector<Eigen::Vector3d>* from_ = nullptr;
  Eigen::Matrix4d transform_ = Eigen::Matrix4d::Identity();
  std::vector<SurfaceKind> kinds_;
};

void ReadSequence(const std::string& text, CityJsonReader& reader, const std::string& file) {
  std::size_t line_number = 0;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    const std::string_view line(text.data() + begin, end - begin);
    begin = end + 1;
    ++line_number;
    if (line.find_first_not_of(" \t\r") == std::string_view::npos) continue;
    reader.BeginLine(line_number);
    const Json json = ParseJson(line, file, reader.place());
    if (!json.is_object()) throw InputError(file, reader.place(), json.type_name(), "an object");
    if (line_number == 1) {
      reader.ReadHeader(json);
    } else if (json.value("type", "") != "CityJSONFeature") {
      throw InputError(file,
                       "line " + std::to_string(line_number),
                       "\"" + json.value("type", "") + "\"",
                       "\"CityJSONFeature\"");
    }
    reader.ReadObjects(json);
  }
}

// A sequence has a whole object on its first line and more after it.
bool IsSequence(const std::string& text) {
  const std::size_t end = text.find('\n');
  if (end == std::string::npos || text.find('{', end) == std::string::npos) return false;
  return Json::accept(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(end));
}

}  // namespace

SourceModel ReadCityJson(InputFile& file) {
  SourceModel model;
  model.file = file.name();
  const std::string text = file.ReadAll();
  if (text.empty()) throw InputError(model.file, "", "an empty file", "a CityJSON document");
  CityJsonReader reader(model);
  try {
    if (IsSequence(text)) {
      ReadSequence(text, reader, model.file);
      model.format.replace(0, 8, "CityJSONSeq");
    } else {
      const Json root = ParseJson(text, model.file);
      if (!root.is_object())
        throw InputError(model.file, "", root.type_name(), "a CityJSON object");
      reader.ReadHeader(root);
      reader.ReadObjects(root);
    }
  } catch (const Json::exception& e) {
    throw InputError(model.file,
                     reader.place(),
                     std::string("a CityJSON structure error (") + e.what() + ")",
                     "CityJSON 1.0 to 2.0");
  }
  return model;
}

}  // namespace ridgeline
