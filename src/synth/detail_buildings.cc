// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>

#include "base/random.h"
#include "synth/building_shape.h"
#include "synth/detail_mesh.h"

namespace ridgeline {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using Eigen::Vector3f;

constexpr std::uint64_t kRoofStage = 0x40;

const std::array<Vector3f, 6> kTileColors = {Vector3f(0.42f, 0.17f, 0.11f),
                                             Vector3f(0.50f, 0.22f, 0.14f),
                                             Vector3f(0.33f, 0.16f, 0.12f),
                                             Vector3f(0.22f, 0.21f, 0.21f),
                                             Vector3f(0.38f, 0.24f, 0.17f),
                                             Vector3f(0.30f, 0.30f, 0.32f)};

void AddWall(const TownBuilding& building,
             const ShapePolygon& wall,
             std::size_t side,
             DetailMesh& mesh) {
  const Vector3d normal = wall.Normal();
  const Vector2d right(-normal.y(), normal.x());  // to the right, seen from outside
  double low = 1e300;
  double high = -1e300;
  for (const Vector3d& p : wall.ring) {
    low = std::min(low, right.dot(p.head<2>()));
    high = std::max(high, right.dot(p.head<2>()));
  }
  std::vector<Vector2d> uv;
  for (const Vector3d& p : wall.ring) {
    uv.emplace_back(right.dot(p.head<2>()) - low, p.z() - building.floor_m);
  }
  // The street is on the side of -y in the building's own axes.
  const Vector2d own_y(-std::sin(building.direction_rad), std::cos(building.direction_rad));
  WallLook look;
  look.length_m = static_cast<float>(high - low);
  look.storeys = building.storeys;
  look.storey_m = static_cast<float>((building.eaves_m - building.floor_m) / building.storeys);
  look.faces_street = normal.head<2>().dot(own_y) < -0.9;
  look.look = building.look;
  look.side = MixBits(building.look + 17 * side);
  DetailTriangle triangle;
  triangle.material = Material::kFacade;
  triangle.wall = static_cast<std::uint32_t>(mesh.walls.size());
  mesh.walls.push_back(look);
  mesh.AddPolygon(wall.ring, uv, triangle);
}

// Chimneys near the ridge and dormers on the slopes: seen in photos, absent from LoD2.
void AddRoofDetails(const TownBuilding& building, const Vector3f& tiles, DetailMesh& mesh) {
  if (building.roof != RoofType::kGable && building.roof != RoofType::kHip) return;
  Random random(building.look, kRoofStage);
  const Vector2d x(std::cos(building.direction_rad), std::sin(building.direction_rad));
  const Vector2d y(-x.y(), x.x());
  const Vector2d u = building.ridge_along_x ? x : y;
  const Vector2d v = building.ridge_along_x ? y : Vector2d(-x);
  const double half_u = 0.5 * (building.ridge_along_x ? building.length_m : building.depth_m);
  const double half_v = 0.5 * (building.ridge_along_x ? building.depth_m : building.length_m);
  const double rise = building.ridge_m - building.eaves_m;

  DetailTriangle brick;
  brick.color = Vector3f(0.35f, 0.18f, 0.13f);
  const auto chimneys = random.Below(3);
  for (std::uint64_t i = 0; i < chimneys; ++i) {
    const double along = random.Uniform(-0.6, 0.6) * half_u;
    const double across = random.Uniform(-0.35, 0.35) * half_v;
    const Vector2d at = building.center + along * u + across * v;
    const double z = building.ridge_m - rise * std::abs(across) / half_v - 0.5;
    const Vector2d size(random.Uniform(0.5, 0.9), random.Uniform(0.5, 0.7));
    mesh.AddFrustum({at.x(), at.y(), z}, u, size, size, random.Uniform(1.3, 2.2), brick);
  }
  if (building.roof != RoofType::kGable || rise < 4.0 || random.Uniform() < 0.5) return;
  DetailTriangle dormer;
  dormer.color = 0.8f * tiles;
  const int count = std::max(1, static_cast<int>(half_u / 3.0));
  for (int i = 0; i < count; ++i) {
    const double along = (2.0 * (i + 0.5) / count - 1.0) * (half_u - 1.0);
    for (const double side : {-0.62, 0.62}) {
      const Vector2d at = building.center + along * u + side * half_v * v;
      const double z = building.ridge_m - rise * std::abs(side) - 0.4;
      mesh.AddFrustum({at.x(), at.y(), z}, u, {1.5, 1.8}, {1.5, 1.8}, 1.5, dormer);
    }
  }
}

}  // namespace

void AddBuildings(const Town& town, double overhang_m, DetailMesh& mesh) {
  for (const TownBuilding& building : town.buildings) {
    Random random(building.look, kRoofStage + 1);
    const bool flat = building.roof == RoofType::kFlat;
    Vector3f tiles = kTileColors[random.Below(kTileColors.size())] *
                     static_cast<float>(random.Uniform(0.85, 1.15));
    if (flat) tiles = Vector3f::Constant(static_cast<float>(random.Uniform(0.25, 0.45)));
    const Vector3f boards = Vector3f::Constant(static_cast<float>(random.Uniform(0.3, 0.75)));
    const double overhang = flat ? 0.08 : overhang_m * random.Uniform(0.7, 1.3);

    std::size_t side = 0;
    for (const ShapePolygon& polygon : LodTwoSolid(building)) {
      if (polygon.surface_class == SurfaceClass::kWall) AddWall(building, polygon, side++, mesh);
    }
    for (const ShapePolygon& polygon : BuiltRoof(building, overhang)) {
      DetailTriangle look;
      const bool covered = polygon.surface_class == SurfaceClass::kRoof && !flat;
      look.material = covered ? Material::kRoof : Material::kPlain;
      look.color = polygon.surface_class == SurfaceClass::kRoof ? tiles : boards;
      mesh.AddPolygon(polygon.ring, {}, look);
    }
    AddRoofDetails(building, tiles, mesh);
  }
}

}  // namespace ridgeline
