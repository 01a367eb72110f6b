// SPDX-License-Identifier: Apache-2.0
#include "synth/building_shape.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace ridgeline {
namespace {

using Eigen::Vector3d;

constexpr double kPlateM = 0.18;  // thickness of the roof plates

// The building's rectangle with the ridge (or the level lines of a shed) along u.
struct RidgeFrame {
  explicit RidgeFrame(const TownBuilding& b) : building(b) {
    const Eigen::Vector2d x(std::cos(b.direction_rad), std::sin(b.direction_rad));
    const Eigen::Vector2d y(-x.y(), x.x());
    u = b.ridge_along_x ? x : y;
    v = b.ridge_along_x ? y : Eigen::Vector2d(-x);
    half_u = 0.5 * (b.ridge_along_x ? b.length_m : b.depth_m);
    half_v = 0.5 * (b.ridge_along_x ? b.depth_m : b.length_m);
  }
  Vector3d At(double along_u, double along_v, double height) const {
    const Eigen::Vector2d xy = building.center + along_u * u + along_v * v;
    return {xy.x(), xy.y(), height};
  }

  const TownBuilding& building;
  Eigen::Vector2d u;
  Eigen::Vector2d v;
  double half_u = 0.0;
  double half_v = 0.0;
};

// Half the length of a hip roof's ridge: all four slopes alike; never shorter than 0.4 m.
double HalfRidge(const RidgeFrame& frame) {
  return std::max(0.2, frame.half_u - std::min(frame.half_u, frame.half_v));
}

// Roof polygons over the rectangle grown by `grow` on all sides; slopes are continued.
std::vector<std::vector<Vector3d>> RoofRings(const RidgeFrame& f, double grow) {
  const TownBuilding& b = f.building;
  const double e = b.eaves_m;
  const double r = b.ridge_m;
  const double hu = f.half_u + grow;
  const double hv = f.half_v + grow;
  switch (b.roof) {
    case RoofType::kFlat:
      return {{f.At(-hu, -hv, e), f.At(hu, -hv, e), f.At(hu, hv, e), f.At(-hu, hv, e)}};
    case RoofType::kGable: {
      const double low = e - (r - e) / f.half_v * grow;
      return {{f.At(-hu, -hv, low), f.At(hu, -hv, low), f.At(hu, 0, r), f.At(-hu, 0, r)},
              {f.At(hu, hv, low), f.At(-hu, hv, low), f.At(-hu, 0, r), f.At(hu, 0, r)}};
    }
    case RoofType::kShed: {
      const double drop = (r - e) / (2.0 * f.half_v) * grow;
      return {{f.At(-hu, -hv, e - drop),
               f.At(hu, -hv, e - drop),
               f.At(hu, hv, r + drop),
               f.At(-hu, hv, r + drop)}};
    }
    case RoofType::kPyramid: {
      const double low = e - (r - e) / f.half_v * grow;
      const Vector3d top = f.At(0, 0, r);
      return {{f.At(-hu, -hv, low), f.At(hu, -hv, low), top},
              {f.At(hu, -hv, low), f.At(hu, hv, low), top},
              {f.At(hu, hv, low), f.At(-hu, hv, low), top},
              {f.At(-hu, hv, low), f.At(-hu, -hv, low), top}};
    }
    case RoofType::kHip: {
      // Grown so that the four slopes keep their planes and meet in level eaves.
      const double half_ridge = HalfRidge(f);
      const double drop = (r - e) / f.half_v * grow;
      const double gu = f.half_u + grow * (f.half_u - half_ridge) / f.half_v;
      const double low = e - drop;
      const Vector3d west = f.At(-half_ridge, 0, r);
      const Vector3d east = f.At(half_ridge, 0, r);
      return {{f.At(-gu, -hv, low), f.At(gu, -hv, low), east, west},
              {f.At(gu, -hv, low), f.At(gu, hv, low), east},
              {f.At(gu, hv, low), f.At(-gu, hv, low), west, east},
              {f.At(-gu, hv, low), f.At(-gu, -hv, low), west}};
    }
  }
  return {};
}

// Outline of the roof polygons: their edges that no other polygon has.
std::vector<std::pair<Vector3d, Vector3d>> Outline(
    const std::vector<std::vector<Vector3d>>& rings) {
  std::vector<std::pair<Vector3d, Vector3d>> outline;
  for (std::size_t i = 0; i < rings.size(); ++i) {
    for (std::size_t k = 0; k < rings[i].size(); ++k) {
      const Vector3d& a = rings[i][k];
      const Vector3d& b = rings[i][(k + 1) % rings[i].size()];
      const bool shared = std::any_of(rings.begin(), rings.end(), [&](const auto& other) {
        if (&other == &rings[i]) return false;
        const auto has = [&](const Vector3d& p) {
          return std::any_of(
              other.begin(), other.end(), [&](const Vector3d& q) { return (p - q).norm() < 1e-9; });
        };
        return has(a) && has(b);
      });
      if (!shared) outline.emplace_back(a, b);
    }
  }
  return outline;
}

}  // namespace

Vector3d ShapePolygon::Normal() const {
  Vector3d sum = Vector3d::Zero();  // Newell
  for (std::size_t i = 0; i < ring.size(); ++i) sum += ring[i].cross(ring[(i + 1) % ring.size()]);
  return sum.normalized();
}

std::vector<ShapePolygon> LodTwoSolid(const TownBuilding& building) {
  const RidgeFrame f(building);
  const double hu = f.half_u;
  const double hv = f.half_v;
  const double z = building.base_m;
  const double e = building.eaves_m;
  const double r = building.ridge_m;
  std::vector<ShapePolygon> solid;
  solid.push_back({SurfaceClass::kGround,
                   {f.At(-hu, -hv, z), f.At(-hu, hv, z), f.At(hu, hv, z), f.At(hu, -hv, z)}});
  for (auto& ring : RoofRings(f, 0.0)) solid.push_back({SurfaceClass::kRoof, std::move(ring)});

  const bool shed = building.roof == RoofType::kShed;
  const bool gable = building.roof == RoofType::kGable;
  const double back = shed ? r : e;
  const auto wall = [&](std::vector<Vector3d> ring) {
    solid.push_back({SurfaceClass::kWall, std::move(ring)});
  };
  wall({f.At(-hu, -hv, z), f.At(hu, -hv, z), f.At(hu, -hv, e), f.At(-hu, -hv, e)});
  wall({f.At(hu, hv, z), f.At(-hu, hv, z), f.At(-hu, hv, back), f.At(hu, hv, back)});
  std::vector<Vector3d> right = {f.At(hu, -hv, z), f.At(hu, hv, z), f.At(hu, hv, back)};
  if (gable) right.push_back(f.At(hu, 0, r));
  right.push_back(f.At(hu, -hv, e));
  wall(std::move(right));
  std::vector<Vector3d> left = {f.At(-hu, hv, z), f.At(-hu, -hv, z), f.At(-hu, -hv, e)};
  if (gable) left.push_back(f.At(-hu, 0, r));
  left.push_back(f.At(-hu, hv, back));
  wall(std::move(left));
  return solid;
}

std::vector<ShapePolygon> BuiltRoof(const TownBuilding& building, double overhang_m) {
  const RidgeFrame f(building);
  const auto rings = RoofRings(f, overhang_m);
  const Vector3d up(0.0, 0.0, kPlateM);
  std::vector<ShapePolygon> roof;
  for (const auto& ring : rings) {
    ShapePolygon top{SurfaceClass::kRoof, {}};
    ShapePolygon bottom{SurfaceClass::kOther, {}};
    for (const Vector3d& p : ring) top.ring.push_back(p + up);
    bottom.ring.assign(ring.rbegin(), ring.rend());
    roof.push_back(std::move(top));
    roof.push_back(std::move(bottom));
  }
  for (const auto& [a, b] : Outline(rings)) {
    roof.push_back({SurfaceClass::kOther, {a, b, b + up, a + up}});
  }
  return roof;
}

}  // namespace ridgeline
