// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <string>
#include <vector>

#include "city/city_model.h"

namespace ridgeline::testing {

// A building with a rectangular footprint: flat roof if ridge_m == eaves_m, else a gabled roof with
// its ridge along the length.
struct House {
  Eigen::Vector2d center = Eigen::Vector2d::Zero();  // local frame [m]
  double length_m = 12.0;
  double width_m = 8.0;
  double heading_deg = 0.0;  // of the length, clockwise from north
  double ground_m = 0.0;     // height of the base
  double eaves_m = 6.0;      // above the base
  double ridge_m = 6.0;
};

// Builds a model polygon by polygon.
class CityBuilder {
 public:
  std::uint32_t AddBuilding(const std::string& id);
  // A closed, oriented house as a building of its own.
  void AddHouse(const House& house);
  // A plane polygon, counter-clockwise from outside, convex. Vertices at equal places are one
  // within the present building.
  std::uint32_t AddSurface(std::uint32_t building,
                           SurfaceClass surface_class,
                           const std::vector<Eigen::Vector3d>& ring);
  // Makes feature edges of the edges between two surfaces (of one building) whose normals differ by
  // at least the angle, and of those with one surface only.
  CityModel Build(double min_dihedral_deg = 10.0) const;

 private:
  CityModel model_;
  std::vector<std::vector<std::uint32_t>> rings_;  // per surface
  std::vector<std::size_t> first_vertex_of_building_;
};

CityModel MakeCity(const std::vector<House>& houses);

// Houses in blocks along streets 12 m wide, heights and roofs drawn, on flat ground at height 0;
// about 16 triangles each. The streets' crossings lie at multiples of kBlockPitch.
inline constexpr double kBlockPitch = 60.0;
std::vector<House> TownHouses(int blocks_east, int blocks_north, std::uint64_t seed);

}  // namespace ridgeline::testing
