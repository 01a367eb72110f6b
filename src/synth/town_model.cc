// SPDX-License-Identifier: Apache-2.0
#include "synth/town_model.h"

#include <cmath>
#include <map>
#include <tuple>

#include "base/random.h"
#include "synth/building_shape.h"

namespace ridgeline {
namespace {

using Eigen::Vector3d;

constexpr std::uint64_t kSurveyStage = 0x30;
const double kCosMinDihedral = std::cos(10.0 * 3.14159265358979323846 / 180.0);

// Welds the vertices of one building at 0.1 mm.
class VertexWelder {
 public:
  explicit VertexWelder(std::vector<Vector3d>& vertices) : vertices_(vertices) {}

  std::uint32_t Index(const Vector3d& p) {
    const auto key =
        std::tuple(std::llround(p.x() * 1e4), std::llround(p.y() * 1e4), std::llround(p.z() * 1e4));
    const auto [it, added] = index_.emplace(key, static_cast<std::uint32_t>(vertices_.size()));
    if (added) vertices_.push_back(p);
    return it->second;
  }

 private:
  std::vector<Vector3d>& vertices_;
  std::map<std::tuple<long long, long long, long long>, std::uint32_t> index_;
};

using EdgeKey = std::pair<std::uint32_t, std::uint32_t>;

void AddBuilding(const TownBuilding& building, std::uint32_t index, CityModel& model) {
  VertexWelder welder(model.vertices);
  std::map<EdgeKey, std::uint32_t> open;  // directed edge -> its surface
  for (const ShapePolygon& polygon : LodTwoSolid(building)) {
    const auto surface = static_cast<std::uint32_t>(model.surfaces.size());
    model.surfaces.push_back({polygon.surface_class, index, polygon.Normal().cast<float>()});
    std::vector<std::uint32_t> ring;
    for (const Vector3d& p : polygon.ring) ring.push_back(welder.Index(p));
    for (std::size_t k = 2; k < ring.size(); ++k) {
      model.triangles.push_back({{ring[0], ring[k - 1], ring[k]}, surface});
    }
    for (std::size_t k = 0; k < ring.size(); ++k) {
      const std::uint32_t a = ring[k];
      const std::uint32_t b = ring[(k + 1) % ring.size()];
      const auto twin = open.find({b, a});
      if (twin == open.end()) {
        open[{a, b}] = surface;
        continue;
      }
      const float cosine = model.surfaces[twin->second].normal.dot(model.surfaces[surface].normal);
      if (cosine < kCosMinDihedral) {
        model.feature_edges.push_back(
            {model.vertices[b], model.vertices[a], twin->second, surface});
      }
      open.erase(twin);
    }
  }
}

}  // namespace

CityModel TownModel(const Town& town) {
  CityModel model;
  model.crs = {town.epsg, 0};
  model.origin_in_world = town.origin_in_world;
  for (const TownBuilding& building : town.buildings) {
    const auto index = static_cast<std::uint32_t>(model.buildings.size());
    const std::string parent = building.parent < 0 ? "" : town.buildings[building.parent].id;
    model.buildings.push_back({building.id, parent});
    AddBuilding(building, index, model);
  }
  return model;
}

HeightGrid TownTerrain(const Town& town, double margin_m, double spacing_m) {
  const Eigen::Vector2d margin(margin_m, margin_m);
  const Eigen::Vector2d lower = (town.Lower() - margin).array().floor();
  const Eigen::Vector2d size = town.Upper() + margin - lower;
  HeightGrid grid;
  grid.first = lower;
  grid.spacing_m = spacing_m;
  grid.columns = static_cast<int>(std::ceil(size.x() / spacing_m)) + 1;
  grid.rows = static_cast<int>(std::ceil(size.y() / spacing_m)) + 1;
  grid.heights.reserve(static_cast<std::size_t>(grid.columns) * grid.rows);
  for (int row = 0; row < grid.rows; ++row) {
    for (int column = 0; column < grid.columns; ++column) {
      const Eigen::Vector2d xy = lower + spacing_m * Eigen::Vector2d(column, row);
      grid.heights.push_back(static_cast<float>(town.TerrainHeight(xy)));
    }
  }
  return grid;
}

Town SurveyedTown(const Town& town, double sigma_m) {
  Town surveyed = town;
  for (std::size_t i = 0; i < town.buildings.size(); ++i) {
    const int parent = town.buildings[i].parent;
    const std::string& id = town.buildings[parent < 0 ? i : static_cast<std::size_t>(parent)].id;
    Random random(static_cast<std::uint64_t>(town.options.seed), kSurveyStage, HashText(id));
    const double east = random.Normal();
    const double north = random.Normal();
    const double height = random.Normal();
    TownBuilding& building = surveyed.buildings[i];
    building.center += sigma_m * Eigen::Vector2d(east, north);
    building.eaves_m += sigma_m * height;
    building.ridge_m += sigma_m * height;
  }
  return surveyed;
}

}  // namespace ridgeline
