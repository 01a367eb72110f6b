// SPDX-License-Identifier: Apache-2.0
#include "city/format/read_citygml.h"

#include <algorithm>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "base/error.h"
#include "base/limits.h"
#include "base/random.h"
#include "city/format/citygml_tags.h"
#include "city/format/citygml_uses.h"
#include "city/format/coordinate_list.h"
#include "city/format/gml_polygon.h"
#include "city/format/xml_stream.h"

namespace ridgeline {
namespace {

// State that an element hands down to its children.
struct Scope {
  GmlTag tag = GmlTag::kOther;
  SurfaceClass surface_class = SurfaceClass::kOther;
  bool has_class = false;
  bool from_boundary = false;
  bool in_solid = false;
  bool reversed = false;
  bool prototype = false;
  std::int8_t lod = -1;
  std::int8_t dimension = 0;  // srsDimension; 0: not said
  std::int32_t building = -1;
  std::uint32_t uses_begin = 0;
  std::uint64_t id_hash = 0;  // of the element itself; 0: none
};

class CityGmlHandler final : public XmlHandler {
 public:
  explicit CityGmlHandler(SourceModel& model) : model_(model), polygon_(model) {}

  bool WantsText() const override { return collecting_; }
  void SetLineSource(const void* parser) override { parser_ = parser; }

  void Start(std::string_view name, const XmlAttributes& attributes) override {
    const std::string_view local = LocalName(name);
    if (stack_.empty()) CheckRoot(local, attributes);
    if (stack_.size() + skip_depth_ >= limits::kXmlDepth) {
      throw InputError(model_.file,
                       "limit",
                       "elements nested deeper than " + std::to_string(limits::kXmlDepth) +
                           " at line " + std::to_string(XmlLine(parser_)),
                       "a document of buildings");
    }
    const GmlElement element = FindGmlElement(local);
    if (skip_depth_ > 0) {
      ++skip_depth_;
      if (element.tag == GmlTag::kPolygon) CountSkipped();
      return;
    }
    const GmlTag parent = stack_.empty() ? GmlTag::kOther : stack_.back().tag;
    if (element.tag == GmlTag::kSkipped) {
      ++skip_depth_;
      return;
    }
    if (element.tag == GmlTag::kInterior && parent == GmlTag::kSolid) {
      model_.tally.Add("inner shells of solids passed over", BuildingId());
      ++skip_depth_;
      return;
    }
    if (parent == GmlTag::kMember && element.tag != GmlTag::kBuilding) CountOther(local);
    Scope scope = stack_.empty() ? Scope{} : stack_.back();
    scope.tag = element.tag;
    scope.uses_begin = static_cast<std::uint32_t>(gml_.uses.size());
    scope.id_hash = 0;
    ReadAttributes(attributes, scope);
    Enter(element, attributes, scope);
    stack_.push_back(scope);
    if (scope.building >= 0 && scope.lod >= 0) {
      const std::string_view href = attributes.Local("href");
      if (!href.empty() && element.tag != GmlTag::kLibraryObject) AddLink(href, scope);
    }
  }

  void End(std::string_view) override {
    if (skip_depth_ > 0) {
      --skip_depth_;
      return;
    }
    const Scope scope = stack_.back();
    stack_.pop_back();
    Leave(scope);
    if (scope.id_hash != 0 && scope.building >= 0) {
      gml_.targets.try_emplace(
          scope.id_hash, GmlTarget{scope.uses_begin, static_cast<std::uint32_t>(gml_.uses.size())});
    }
  }

  void Text(std::string_view text) override {
    Numbers([&] { list_.Feed(text); });
  }

  void Finish() { AssignMembers(gml_, model_); }

 private:
  [[noreturn]] void Fail(const std::string& found, const std::string& expected) const {
    throw InputError(model_.file, "line " + std::to_string(XmlLine(parser_)), found, expected);
  }

  template <typename Body>
  void Numbers(const Body& body) {
    try {
      body();
    } catch (const std::invalid_argument& e) {
      Fail("\"" + std::string(e.what()) + "\" among coordinates", "finite decimal numbers");
    }
  }

  std::string BuildingIdOf(const Scope& scope) const {
    if (scope.building < 0) return {};
    return model_.buildings[static_cast<std::size_t>(scope.building)].id;
  }
  std::string BuildingId() const { return stack_.empty() ? "" : BuildingIdOf(stack_.back()); }

  void CheckRoot(std::string_view local, const XmlAttributes& attributes) {
    if (local != "CityModel" && local != "FeatureCollection") {
      Fail("an XML document of <" + std::string(local) + ">", "a CityGML <CityModel>");
    }
    model_.format = "CityGML";
    for (const char** pair = attributes.pairs(); *pair != nullptr; pair += 2) {
      const std::string_view version = CityGmlVersion(pair[1]);
      // Tools declare namespaces they do not use; the buildings' one decides.
      const bool of_buildings = std::string_view(pair[1]).find("/building/") != std::string::npos;
      if (!version.empty() && (of_buildings || model_.format == "CityGML")) model_.format = version;
    }
  }

  // Of rooms, furniture, inner surfaces and inner shells.
  void CountSkipped() {
    if (!stack_.empty() && stack_.back().building >= 0) {
      model_.tally.Add("polygons inside of buildings passed over", BuildingId());
    }
  }

  void CountOther(std::string_view local) {
    if (local != "CityObjectGroup") {
      model_.tally.Add(std::string(local) + " objects (not buildings) passed over", std::size_t{1});
    }
  }

  void ReadAttributes(const XmlAttributes& attributes, Scope& scope) {
    for (const char** pair = attributes.pairs(); *pair != nullptr; pair += 2) {
      const std::string_view key = LocalName(pair[0]);
      const std::string_view value = pair[1];
      if (key == "id") {
        scope.id_hash = HashText(value);
      } else if (key == "srsName") {
        AddSrsName(value);
      } else if (key == "uomLabels" && model_.axis_units.empty()) {
        std::istringstream words{std::string(value)};
        for (std::string word; words >> word;) model_.axis_units.push_back(word);
      } else if (key == "srsDimension") {
        scope.dimension = value == "2" ? 2 : 3;
      }
    }
  }

  void AddSrsName(std::string_view value) {
    std::vector<std::string>& names = model_.srs_names;
    if (!value.empty() && (names.empty() || names.back() != value) &&
        std::find(names.begin(), names.end(), value) == names.end()) {
      names.emplace_back(value);
    }
  }

  void Enter(const GmlElement& element, const XmlAttributes& attributes, Scope& scope) {
    switch (element.tag) {
      case GmlTag::kBuilding:
        EnterBuilding(attributes, scope);
        break;
      case GmlTag::kBoundary:
      case GmlTag::kOpening:
      case GmlTag::kInstallation:
        scope.surface_class = element.surface_class;
        scope.has_class = element.has_class;
        scope.from_boundary = true;
        scope.lod = -1;
        break;
      case GmlTag::kLod:
        scope.lod = element.lod;
        break;
      case GmlTag::kSolid:
        scope.in_solid = true;
        break;
      case GmlTag::kOrientable:
        if (attributes.Local("orientation") == "-") scope.reversed = !scope.reversed;
        break;
      case GmlTag::kPolygon:
        EnterPolygon(attributes, scope);
        break;
      case GmlTag::kRing:
        in_ring_ = in_polygon_;
        polygon_.BeginRing();
        break;
      case GmlTag::kCoordinates:
        collecting_ = in_ring_ || in_reference_;
        list_.Begin();
        break;
      case GmlTag::kTuples:
        collecting_ = in_ring_ || in_reference_;
        BeginTuples(attributes);
        break;
      case GmlTag::kMatrix:
        collecting_ = InLod(scope);
        list_.Begin();
        break;
      case GmlTag::kImplicit:
        implicit_ = GmlImplicit{};
        placed_ = false;
        implicit_.prototype = {scope.uses_begin, scope.uses_begin};
        break;
      case GmlTag::kReferencePoint:
        in_reference_ = InLod(scope);
        reference_.clear();
        break;
      case GmlTag::kPrototype:
        scope.prototype = true;
        break;
      case GmlTag::kLibraryObject:
        model_.tally.Add("implicit geometries in other files not read", BuildingId());
        break;
      default:
        break;
    }
  }

  // gml:coordinates says itself what stands between its numbers.
  void BeginTuples(const XmlAttributes& attributes) {
    const std::string_view decimal = attributes.Local("decimal");
    const std::string_view between = attributes.Local("cs");
    list_.Begin(std::string(between.empty() ? "," : between).append(attributes.Local("ts")),
                decimal.empty() ? '.' : decimal.front());
  }

  static bool InLod(const Scope& scope) { return scope.building >= 0 && scope.lod >= 0; }

  void EnterBuilding(const XmlAttributes& attributes, Scope& scope) {
    SourceBuilding building;
    building.id = attributes.Local("id");
    building.parent = scope.building;
    scope = Scope{.tag = GmlTag::kBuilding,
                  .dimension = scope.dimension,
                  .building = static_cast<std::int32_t>(model_.buildings.size()),
                  .uses_begin = scope.uses_begin,
                  .id_hash = scope.id_hash};
    model_.buildings.push_back(std::move(building));
  }

  void EnterPolygon(const XmlAttributes& attributes, const Scope& scope) {
    in_polygon_ = InLod(scope);
    if (!in_polygon_) {
      if (scope.building >= 0) {
        model_.tally.Add("polygons outside of any lodN property passed over", BuildingId());
      }
      return;
    }
    if (!scope.prototype) ++model_.polygons_of_lod[scope.lod].met;
    polygon_.BeginPolygon(attributes.Local("id"));
  }

  void AddLink(std::string_view href, const Scope& scope) {
    GmlUse use = UseOf(scope);
    use.kind = GmlUse::Kind::kLink;
    use.index = static_cast<std::uint32_t>(gml_.links.size());
    gml_.links.emplace_back(href);
    gml_.uses.push_back(use);
  }

  static GmlUse UseOf(const Scope& scope) {
    GmlUse use;
    use.building = scope.building;
    use.lod = scope.lod;
    use.surface_class = scope.surface_class;
    use.has_class = scope.has_class;
    use.from_boundary = scope.from_boundary;
    use.in_solid = scope.in_solid;
    use.reversed = scope.reversed;
    use.prototype = scope.prototype;
    return use;
  }

  void Leave(const Scope& scope) {
    switch (scope.tag) {
      case GmlTag::kCoordinates:
      case GmlTag::kTuples:
        if (collecting_) LeaveCoordinates(scope);
        break;
      case GmlTag::kMatrix:
        if (collecting_) LeaveMatrix();
        break;
      case GmlTag::kRing:
        if (in_ring_) polygon_.EndRing(BuildingIdOf(scope));
        in_ring_ = false;
        break;
      case GmlTag::kPolygon:
        if (in_polygon_) LeavePolygon(scope);
        in_polygon_ = false;
        break;
      case GmlTag::kReferencePoint:
        if (in_reference_) LeaveReference();
        in_reference_ = false;
        break;
      case GmlTag::kImplicit:
        if (InLod(scope)) LeaveImplicit(scope);
        break;
      default:
        break;
    }
  }

  void LeaveCoordinates(const Scope& scope) {
    Numbers([&] { list_.Finish(); });
    collecting_ = false;
    const std::vector<double>& numbers = list_.numbers();
    if (in_ring_) {
      polygon_.AddNumbers(numbers, scope.dimension);
    } else {
      reference_.insert(reference_.end(), numbers.begin(), numbers.end());
    }
  }

  void LeaveReference() {
    placed_ = reference_.size() == 3;
    if (placed_) implicit_.reference = Eigen::Map<const Eigen::Vector3d>(reference_.data());
  }

  void LeaveMatrix() {
    Numbers([&] { list_.Finish(); });
    collecting_ = false;
    const std::vector<double>& numbers = list_.numbers();
    if (numbers.size() != 16) {
      Fail(std::to_string(numbers.size()) + " numbers in a transformationMatrix", "16");
    }
    implicit_.matrix =
        Eigen::Map<const Eigen::Matrix<double, 4, 4, Eigen::RowMajor>>(numbers.data());
  }

  void LeavePolygon(const Scope& scope) {
    const std::optional<std::uint32_t> polygon = polygon_.EndPolygon(BuildingIdOf(scope));
    if (!polygon) {
      if (!scope.prototype) ++model_.polygons_of_lod[scope.lod].named;
      return;
    }
    GmlUse use = UseOf(scope);
    use.index = *polygon;
    gml_.uses.push_back(use);
  }

  void LeaveImplicit(const Scope& scope) {
    if (!placed_) {
      model_.tally.Add("implicit geometries without a place of three coordinates dropped",
                       BuildingIdOf(scope));
      return;
    }
    implicit_.prototype.end = static_cast<std::uint32_t>(gml_.uses.size());
    GmlUse use = UseOf(scope);
    use.kind = GmlUse::Kind::kImplicit;
    use.index = static_cast<std::uint32_t>(gml_.implicits.size());
    gml_.implicits.push_back(implicit_);
    gml_.uses.push_back(use);
  }

  SourceModel& model_;
  GmlUses gml_;
  const void* parser_ = nullptr;
  std::vector<Scope> stack_;
  std::size_t skip_depth_ = 0;
  bool collecting_ = false;
  bool in_polygon_ = false;
  bool in_ring_ = false;
  bool in_reference_ = false;
  CoordinateList list_;
  GmlPolygonBuilder polygon_;
  GmlImplicit implicit_;
  bool placed_ = false;
  std::vector<double> reference_;
};

}  // namespace

SourceModel ReadCityGml(InputFile& file) {
  SourceModel model;
  model.file = file.name();
  CityGmlHandler handler(model);
  ParseXml(file, handler);
  handler.Finish();
  return model;
}

}  // namespace ridgeline
