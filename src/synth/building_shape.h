// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <vector>

#include "city/city_model.h"
#include "synth/town.h"

namespace ridgeline {

// A planar convex polygon of a building, counter-clockwise seen from outside, local frame [m].
struct ShapePolygon {
  SurfaceClass surface_class = SurfaceClass::kWall;
  std::vector<Eigen::Vector3d> ring;  // open: the first point is not repeated

  Eigen::Vector3d Normal() const;  // outward, unit
};

// The LoD2 solid of a building: closed, every edge shared by exactly two polygons.
std::vector<ShapePolygon> LodTwoSolid(const TownBuilding& building);

// The roof as it is built: plates that overhang the walls by `overhang_m`, with eaves boards, above
// the planes of LodTwoSolid. Flat roofs get a parapet cap.
std::vector<ShapePolygon> BuiltRoof(const TownBuilding& building, double overhang_m);

}  // namespace ridgeline
