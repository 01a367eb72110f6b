// SPDX-License-Identifier: Apache-2.0
#include "support/synthetic_city.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <tuple>
#include <utility>

#include "base/random.h"

namespace ridgeline::testing {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

std::uint32_t VertexAt(CityModel& model, const Eigen::Vector3d& point, std::size_t from) {
  for (std::size_t i = from; i < model.vertices.size(); ++i) {
    if ((model.vertices[i] - point).norm() < 1e-6) return static_cast<std::uint32_t>(i);
  }
  model.vertices.push_back(point);
  return static_cast<std::uint32_t>(model.vertices.size() - 1);
}

}  // namespace

std::uint32_t CityBuilder::AddBuilding(const std::string& id) {
  model_.buildings.push_back({id, ""});
  first_vertex_of_building_.push_back(model_.vertices.size());
  return static_cast<std::uint32_t>(model_.buildings.size() - 1);
}

std::uint32_t CityBuilder::AddSurface(std::uint32_t building,
                                      SurfaceClass surface_class,
                                      const std::vector<Eigen::Vector3d>& ring) {
  const auto surface = static_cast<std::uint32_t>(model_.surfaces.size());
  // Vertices are shared within a building: among those of its surfaces.
  const std::size_t recent = first_vertex_of_building_[building];
  std::vector<std::uint32_t> indices;
  for (const Eigen::Vector3d& point : ring) indices.push_back(VertexAt(model_, point, recent));
  const Eigen::Vector3d normal = (ring[1] - ring[0]).cross(ring[2] - ring[0]).normalized();
  model_.surfaces.push_back({surface_class, building, normal.cast<float>()});
  for (std::size_t k = 1; k + 1 < indices.size(); ++k) {
    model_.triangles.push_back({{indices[0], indices[k], indices[k + 1]}, surface});
  }
  rings_.push_back(std::move(indices));
  return surface;
}

void CityBuilder::AddHouse(const House& house) {
  const std::uint32_t building = AddBuilding("house-" + std::to_string(model_.buildings.size()));
  const double heading = house.heading_deg * kDegree;
  const Eigen::Vector2d along(std::sin(heading), std::cos(heading));
  const Eigen::Vector2d across(std::cos(heading), -std::sin(heading));
  const auto corner = [&](double l, double w, double height) {
    const Eigen::Vector2d p =
        house.center + l * house.length_m / 2 * along + w * house.width_m / 2 * across;
    return Eigen::Vector3d(p.x(), p.y(), house.ground_m + height);
  };
  const double eaves = house.eaves_m;
  const double ridge = house.ridge_m;
  const auto wall = SurfaceClass::kWall;
  AddSurface(building,
             SurfaceClass::kGround,
             {corner(-1, -1, 0), corner(1, -1, 0), corner(1, 1, 0), corner(-1, 1, 0)});
  AddSurface(building,
             wall,
             {corner(-1, 1, 0), corner(1, 1, 0), corner(1, 1, eaves), corner(-1, 1, eaves)});
  AddSurface(building,
             wall,
             {corner(1, -1, 0), corner(-1, -1, 0), corner(-1, -1, eaves), corner(1, -1, eaves)});
  if (ridge > eaves) {
    AddSurface(building,
               wall,
               {corner(1, 1, 0),
                corner(1, -1, 0),
                corner(1, -1, eaves),
                corner(1, 0, ridge),
                corner(1, 1, eaves)});
    AddSurface(building,
               wall,
               {corner(-1, -1, 0),
                corner(-1, 1, 0),
                corner(-1, 1, eaves),
                corner(-1, 0, ridge),
                corner(-1, -1, eaves)});
    AddSurface(
        building,
        SurfaceClass::kRoof,
        {corner(-1, 1, eaves), corner(1, 1, eaves), corner(1, 0, ridge), corner(-1, 0, ridge)});
    AddSurface(
        building,
        SurfaceClass::kRoof,
        {corner(1, -1, eaves), corner(-1, -1, eaves), corner(-1, 0, ridge), corner(1, 0, ridge)});
    return;
  }
  AddSurface(building,
             wall,
             {corner(1, 1, 0), corner(1, -1, 0), corner(1, -1, eaves), corner(1, 1, eaves)});
  AddSurface(building,
             wall,
             {corner(-1, -1, 0), corner(-1, 1, 0), corner(-1, 1, eaves), corner(-1, -1, eaves)});
  AddSurface(
      building,
      SurfaceClass::kRoof,
      {corner(-1, -1, eaves), corner(-1, 1, eaves), corner(1, 1, eaves), corner(1, -1, eaves)});
}

CityModel CityBuilder::Build(double min_dihedral_deg) const {
  CityModel model = model_;
  // Edge -> the surfaces at it, ordered by vertices so that the result is too.
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::vector<std::uint32_t>> surfaces_at;
  for (std::size_t s = 0; s < rings_.size(); ++s) {
    for (std::size_t k = 0; k < rings_[s].size(); ++k) {
      const std::uint32_t a = rings_[s][k];
      const std::uint32_t b = rings_[s][(k + 1) % rings_[s].size()];
      if (a == b) continue;
      surfaces_at[std::minmax(a, b)].push_back(static_cast<std::uint32_t>(s));
    }
  }
  const double least = std::cos(min_dihedral_deg * kDegree);
  for (const auto& [vertices, surfaces] : surfaces_at) {
    FeatureEdge edge;
    edge.a = model.vertices[vertices.first];
    edge.b = model.vertices[vertices.second];
    edge.surface0 = surfaces[0];
    if (surfaces.size() > 1) {
      edge.surface1 = surfaces[1];
      const double cosine = model.surfaces[surfaces[0]].normal.cast<double>().dot(
          model.surfaces[surfaces[1]].normal.cast<double>());
      if (surfaces.size() == 2 && cosine > least) continue;
    }
    model.feature_edges.push_back(edge);
  }
  return model;
}

CityModel MakeCity(const std::vector<House>& houses) {
  CityBuilder builder;
  for (const House& house : houses) builder.AddHouse(house);
  return builder.Build();
}

std::vector<House> TownHouses(int blocks_east, int blocks_north, std::uint64_t seed) {
  constexpr double kStreet = 12.0;
  constexpr double kDepth = 10.0;  // of a house, across the street
  const double side = kBlockPitch - kStreet;
  std::vector<House> houses;
  for (int north = 0; north < blocks_north; ++north) {
    for (int east = 0; east < blocks_east; ++east) {
      Random random(seed,
                    HashText("town block"),
                    static_cast<std::uint64_t>(north) * 100003u + static_cast<std::uint64_t>(east));
      const Eigen::Vector2d origin(east * kBlockPitch + kStreet / 2,
                                   north * kBlockPitch + kStreet / 2);
      // Rows along the southern and the northern street, house by house with some gaps.
      for (const double row : {kDepth / 2, side - kDepth / 2}) {
        for (double at = 0.0; at < side - 6.0;) {
          House house;
          house.length_m = std::min(random.Uniform(8.0, 18.0), side - at);
          house.width_m = kDepth - random.Uniform(0.0, 2.0);
          house.center = origin + Eigen::Vector2d(at + house.length_m / 2, row);
          house.heading_deg = 90.0;
          house.eaves_m = random.Uniform(5.0, 16.0);
          house.ridge_m = house.eaves_m + (random.Uniform() < 0.3 ? 0.0 : random.Uniform(2.0, 5.0));
          houses.push_back(house);
          at += house.length_m + (random.Uniform() < 0.3 ? random.Uniform(2.0, 5.0) : 0.01);
        }
      }
    }
  }
  return houses;
}

}  // namespace ridgeline::testing
