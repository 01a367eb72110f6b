// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <string>
#include <unordered_map>
#include <vector>

#include "city/source_model.h"

namespace ridgeline {

// Where geometry stands in a document: one polygon, a link to geometry that stands elsewhere, or an
// implicit geometry (a prototype that is moved to its place).
struct GmlUse {
  enum class Kind : std::uint8_t { kPolygon, kLink, kImplicit };
  Kind kind = Kind::kPolygon;
  std::uint32_t index = 0;  // into SourceModel::polygons, GmlUses::links or GmlUses::implicits
  std::int32_t building = -1;
  std::int8_t lod = -1;
  SurfaceClass surface_class = SurfaceClass::kOther;
  bool has_class = false;
  bool from_boundary = false;  // under a boundary surface or an installation
  bool in_solid = false;
  bool reversed = false;
  bool prototype = false;  // only to be used through an implicit geometry
};

// A run of GmlUses::uses that an id stands for.
struct GmlTarget {
  std::uint32_t begin = 0;
  std::uint32_t end = 0;
};

struct GmlImplicit {
  Eigen::Matrix4d matrix = Eigen::Matrix4d::Identity();
  Eigen::Vector3d reference = Eigen::Vector3d::Zero();
  GmlTarget prototype;
};

struct GmlUses {
  std::vector<GmlUse> uses;
  std::vector<std::string> links;
  std::vector<GmlImplicit> implicits;
  std::unordered_map<std::uint64_t, GmlTarget> targets;  // by HashText(gml:id)
};

// Follows the links and gives every building its polygons, each polygon once per level of detail:
// boundary surfaces first, then what solids and plain surfaces add. Links that lead nowhere, solids
// that only repeat their boundary surfaces, and the like are counted in model.tally.
void AssignMembers(const GmlUses& gml, SourceModel& model);

}  // namespace ridgeline
