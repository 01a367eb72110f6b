// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "city/city_model.h"
#include "city/tally.h"

namespace ridgeline {

// What a model file holds, in its own coordinates and with all its levels of detail: the common
// product of the format readers. Arrays are flat, so that a tile of millions of points is a few
// allocations.

struct SourceRing {
  std::uint32_t first_point = 0;
  std::uint32_t point_count = 0;  // open: the first point is not repeated at the end
};

struct SourcePolygon {
  std::uint32_t first_ring = 0;  // the outer ring, then the holes
  std::uint32_t ring_count = 0;
  std::string id;  // as in the file; may be empty
};

// The use of a polygon in a building.
struct SourceMember {
  std::uint32_t polygon = 0;
  std::int8_t lod = -1;
  SurfaceClass surface_class = SurfaceClass::kOther;
  bool has_class = false;  // from a boundary surface or semantics; otherwise its normal decides
  bool reversed = false;   // used with its back to the outside
};

struct SourceBuilding {
  std::string id;  // empty where the file gives none
  int parent = -1;
  std::vector<SourceMember> members;
};

// What became of the polygons of one level of detail: met = read + named.
struct PolygonCount {
  std::size_t met = 0;    // in the file, as it writes them
  std::size_t read = 0;   // of these, members of a building
  std::size_t named = 0;  // of these, passed over for a reason that the tally names
};

struct SourceModel {
  std::string file;
  std::string format;                  // e.g. "CityGML 2.0"
  std::vector<std::string> srs_names;  // as written, distinct, in order of appearance
  // Units of the axes as written (uomLabels of CityGML), e.g. "ft"; empty: not said.
  std::vector<std::string> axis_units;
  std::vector<Eigen::Vector3d> points;
  std::vector<SourceRing> rings;
  std::vector<SourcePolygon> polygons;
  std::vector<SourceBuilding> buildings;
  Tally tally;
  std::map<int, PolygonCount> polygons_of_lod;  // -1: of no level
  // East and north of everything in a store of which a part was read; else empty.
  Eigen::AlignedBox2d whole_extent;
};

}  // namespace ridgeline
