// SPDX-License-Identifier: Apache-2.0
#include "city/format/citygml_uses.h"

#include <Eigen/Geometry>
#include <set>
#include <string>
#include <utility>

#include "base/error.h"
#include "base/limits.h"
#include "base/random.h"

namespace ridgeline {
namespace {

class Assigner {
 public:
  Assigner(const GmlUses& gml, SourceModel& model)
      : gml_(gml),
        model_(model),
        most_(limits::kLinkedPolygons + limits::kPolygonsPerUse * gml.uses.size()),
        used_(model.polygons.size(), 0) {
    FindThematicBuildings();
  }

  void Run() {
    std::vector<bool> named(gml_.uses.size(), false);
    for (const Rank rank : {Rank::kBoundary, Rank::kSolid, Rank::kLoose}) {
      for (std::size_t u = 0; u < gml_.uses.size(); ++u) {
        const GmlUse& use = gml_.uses[u];
        if (use.prototype || use.building < 0 || use.lod < 0 || RankOf(use) != rank) continue;
        if (rank == Rank::kSolid && RepeatsBoundary(use)) {
          model_.tally.Add("polygons of solids not used beside boundary surfaces",
                           model_.buildings[static_cast<std::size_t>(use.building)].id);
          named[u] = true;
          continue;
        }
        Expand(use, use, use.reversed, 0);
      }
    }
    CountPolygons(named);
  }

 private:
  enum class Rank { kBoundary, kSolid, kLoose };

  static Rank RankOf(const GmlUse& use) {
    if (use.from_boundary) return Rank::kBoundary;
    return use.in_solid ? Rank::kSolid : Rank::kLoose;
  }

  // Buildings (and levels) with boundary surfaces, and those whose solids link to anything.
  void FindThematicBuildings() {
    for (const GmlUse& use : gml_.uses) {
      if (use.building < 0 || use.lod < 0) continue;
      const std::pair key(use.building, use.lod);
      if (use.from_boundary) with_boundary_.insert(key);
      if (use.in_solid && use.kind == GmlUse::Kind::kLink) with_linked_solid_.insert(key);
    }
  }

  // A solid that is written out in full beside boundary surfaces says the same thing twice; one
  // that links to them may add polygons of its own.
  bool RepeatsBoundary(const GmlUse& use) const {
    const std::pair key(use.building, use.lod);
    return use.kind == GmlUse::Kind::kPolygon && with_boundary_.contains(key) &&
           !with_linked_solid_.contains(key);
  }

  void CountPolygons(const std::vector<bool>& named) {
    for (std::size_t u = 0; u < gml_.uses.size(); ++u) {
      const GmlUse& use = gml_.uses[u];
      if (use.kind != GmlUse::Kind::kPolygon || use.prototype) continue;
      PolygonCount& count = model_.polygons_of_lod[use.lod];
      if (((used_[use.index] >> use.lod) & 1) != 0) {
        ++count.read;
      } else if (named[u]) {
        ++count.named;
      }
    }
  }

  // One more step along links, or copied points.
  void Spend(std::size_t points) {
    copied_ += points;
    if (++steps_ <= most_ && copied_ <= limits::kCopiedPoints) return;
    throw InputError(model_.file,
                     "limit",
                     copied_ > limits::kCopiedPoints
                         ? "implicit geometries of more than " +
                               std::to_string(limits::kCopiedPoints) + " points"
                         : "links that stand for more than " + std::to_string(most_) + " polygons",
                     "geometry that is written out, not multiplied by links");
  }

  const std::string& BuildingId(const GmlUse& use) const {
    return model_.buildings[static_cast<std::size_t>(use.building)].id;
  }

  // Adds the polygons that `use` stands for, with the building, level and class of `holder`.
  void Expand(const GmlUse& use, const GmlUse& holder, bool reversed, int depth) {
    Spend(0);
    switch (use.kind) {
      case GmlUse::Kind::kPolygon:
        AddPolygon(use, holder, reversed);
        return;
      case GmlUse::Kind::kImplicit:
        AddImplicit(gml_.implicits[use.index], holder, reversed, depth);
        return;
      case GmlUse::Kind::kLink: {
        const GmlTarget* const target = FindTarget(gml_.links[use.index], holder);
        if (target != nullptr) ExpandRange(*target, holder, reversed, depth);
        return;
      }
    }
  }

  void ExpandRange(const GmlTarget& target, const GmlUse& holder, bool reversed, int depth) {
    if (depth >= limits::kLinkDepth) {
      model_.tally.Add("links followed in a circle", BuildingId(holder));
      return;
    }
    for (std::uint32_t i = target.begin; i < target.end; ++i) {
      Expand(gml_.uses[i], holder, reversed != gml_.uses[i].reversed, depth + 1);
    }
  }

  const GmlTarget* FindTarget(const std::string& href, const GmlUse& holder) {
    const std::size_t hash = href.find('#');
    if (hash == std::string::npos || (hash > 0 && !IsThisFile(href.substr(0, hash)))) {
      model_.tally.Add("links into other files not followed", href);
      return nullptr;
    }
    const auto it = gml_.targets.find(HashText(std::string_view(href).substr(hash + 1)));
    if (it == gml_.targets.end()) {
      model_.tally.Add("links to geometry that the file does not hold", BuildingId(holder));
      return nullptr;
    }
    return &it->second;
  }

  bool IsThisFile(const std::string& name) const {
    const std::size_t slash = model_.file.rfind('/');
    return name == (slash == std::string::npos ? model_.file : model_.file.substr(slash + 1));
  }

  void AddPolygon(const GmlUse& use, const GmlUse& holder, bool reversed) {
    const auto bit = static_cast<std::uint8_t>(1u << holder.lod);
    // The same polygon seen from its other side is the face of a neighbour, not a repetition.
    const bool neighbour_side = reversed && use.building != holder.building;
    if ((used_[use.index] & bit) != 0 && !neighbour_side) return;
    used_[use.index] |= bit;
    SourceMember member;
    member.polygon = use.index;
    member.lod = holder.lod;
    member.reversed = reversed;
    const GmlUse& classified = holder.has_class ? holder : use;
    member.has_class = classified.has_class;
    member.surface_class = classified.surface_class;
    model_.buildings[static_cast<std::size_t>(holder.building)].members.push_back(member);
  }

  void AddImplicit(const GmlImplicit& implicit, const GmlUse& holder, bool reversed, int depth) {
    if (depth >= limits::kLinkDepth) return;
    for (std::uint32_t i = implicit.prototype.begin; i < implicit.prototype.end; ++i) {
      const GmlUse& use = gml_.uses[i];
      Spend(0);
      if (use.kind == GmlUse::Kind::kPolygon) {
        GmlUse moved = use;
        moved.index = MovedCopy(use.index, implicit);
        AddPolygon(moved, holder, reversed != use.reversed);
      } else if (use.kind == GmlUse::Kind::kLink) {
        const GmlTarget* const target = FindTarget(gml_.links[use.index], holder);
        if (target == nullptr) continue;
        GmlImplicit linked = implicit;
        linked.prototype = *target;
        AddImplicit(linked, holder, reversed != use.reversed, depth + 1);
      }
    }
  }

  std::uint32_t MovedCopy(std::uint32_t polygon, const GmlImplicit& implicit) {
    SourcePolygon copy = model_.polygons[polygon];
    const std::uint32_t first_ring = copy.first_ring;
    copy.first_ring = static_cast<std::uint32_t>(model_.rings.size());
    for (std::uint32_t r = 0; r < copy.ring_count; ++r) {
      SourceRing ring = model_.rings[first_ring + r];
      const std::uint32_t first_point = ring.first_point;
      Spend(ring.point_count);
      ring.first_point = static_cast<std::uint32_t>(model_.points.size());
      for (std::uint32_t p = 0; p < ring.point_count; ++p) {
        const Eigen::Vector4d moved =
            implicit.matrix * model_.points[first_point + p].homogeneous();
        model_.points.push_back(moved.hnormalized() + implicit.reference);
      }
      model_.rings.push_back(ring);
    }
    model_.polygons.push_back(copy);
    used_.push_back(0);
    return static_cast<std::uint32_t>(model_.polygons.size() - 1);
  }

  const GmlUses& gml_;
  SourceModel& model_;
  const std::size_t most_;
  std::size_t steps_ = 0;
  std::size_t copied_ = 0;
  std::vector<std::uint8_t> used_;  // per polygon: a bit per level of detail
  std::set<std::pair<std::int32_t, std::int8_t>> with_boundary_;
  std::set<std::pair<std::int32_t, std::int8_t>> with_linked_solid_;
};

}  // namespace

void AssignMembers(const GmlUses& gml, SourceModel& model) { Assigner(gml, model).Run(); }

}  // namespace ridgeline
