// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/random.h"
#include "synth/detail_mesh.h"

namespace ridgeline {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using Eigen::Vector3f;

constexpr std::uint64_t kStreetStage = 0x50;

Vector3f Gray(double value) { return Vector3f::Constant(static_cast<float>(value)); }

DetailTriangle Look(Material material, const Vector3f& color) {
  DetailTriangle look;
  look.material = material;
  look.color = color;
  return look;
}

class StreetLife {
 public:
  StreetLife(const Town& town, DetailMesh& mesh) : town_(town), mesh_(mesh) {}

  void AddAlongSide(const Vector2d& start, const Vector2d& end, Random& random) {
    const Vector2d along = (end - start).normalized();
    const Vector2d inward(-along.y(), along.x());
    const double length = (end - start).norm();
    const double tree_share = random.Uniform() < 0.5 ? 0.35 * town_.options.trees : 0.0;
    const double car_share = random.Uniform(0.15, 0.6);
    for (double at = 4.0; at < length - 4.0; at += 7.0) {
      const Vector2d curb = start + at * along;
      if (random.Uniform() < car_share) AddCar(curb - 1.15 * inward, along, random);
      if (random.Uniform() < tree_share) AddTree(curb + 0.6 * inward, random);
      if (random.Uniform() < 0.12) AddPerson(curb + random.Uniform(0.8, 2.0) * inward, random);
      if (random.Uniform() < 0.08) AddSign(curb + 0.3 * inward, along, random);
    }
    for (double at = 9.0; at < length; at += 27.0)
      AddLamp(start + at * along + 0.3 * inward, inward);
  }

  void AddTree(const Vector2d& xy, Random& random) {
    const double height = random.Uniform(4.5, 9.0);
    const double radius = random.Uniform(1.2, 2.2);
    const Vector3d foot = OnGround(xy);
    mesh_.AddFrustum(foot,
                     {1.0, 0.0},
                     {0.3, 0.3},
                     {0.18, 0.18},
                     0.6 * height,
                     Look(Material::kPlain, {0.20f, 0.15f, 0.11f}));
    const Vector3f green(static_cast<float>(random.Uniform(0.08, 0.30)),
                         static_cast<float>(random.Uniform(0.20, 0.32)),
                         static_cast<float>(random.Uniform(0.04, 0.10)));
    const Vector3d middle = foot + Vector3d(0.0, 0.0, 0.68 * height);
    for (int i = 0; i < 1100; ++i) AddLeaf(middle, radius, 0.34 * height, green, random);
  }

 private:
  Vector3d OnGround(const Vector2d& xy) const { return {xy.x(), xy.y(), town_.TerrainHeight(xy)}; }

  // One triangle of foliage in an ellipsoid, denser towards its surface.
  void AddLeaf(const Vector3d& middle,
               double radius,
               double half_height,
               const Vector3f& green,
               Random& random) {
    const double turn = random.Uniform(0.0, 2.0 * std::numbers::pi);
    const double z = random.Uniform(-1.0, 1.0);
    const double r = std::pow(random.Uniform(), 0.4);
    const double ring = std::sqrt(1.0 - z * z);
    const Vector3d at = middle + Vector3d(radius * r * ring * std::cos(turn),
                                          radius * r * ring * std::sin(turn),
                                          half_height * r * z);
    std::array<Vector3d, 3> corners;
    for (Vector3d& corner : corners) {
      corner = at + 0.19 * Vector3d(random.Normal(), random.Normal(), random.Normal());
    }
    mesh_.AddPolygon(
        corners, {}, Look(Material::kLeaves, green * static_cast<float>(random.Uniform(0.7, 1.3))));
  }

  void AddCar(const Vector2d& xy, const Vector2d& along, Random& random) {
    const Vector3d foot = OnGround(xy);
    const double hue = random.Uniform();
    const auto shade = static_cast<float>(random.Uniform(0.4, 1.0));
    const Vector3f paint = hue < 0.65   ? Gray(random.Uniform(0.03, 0.7))
                           : hue < 0.80 ? Vector3f(0.06f, 0.12f, 0.35f) * shade
                           : hue < 0.92 ? Vector3f(0.42f, 0.04f, 0.04f) * shade
                                        : Vector3f(0.08f, 0.22f, 0.12f) * shade;
    const double length = random.Uniform(3.8, 4.9);
    const bool van = random.Uniform() < 0.15;
    const auto part = [&](double offset,
                          double z,
                          const Vector2d& lower,
                          const Vector2d& upper,
                          double height,
                          const DetailTriangle& look) {
      const Vector2d at = xy + offset * along;
      mesh_.AddFrustum({at.x(), at.y(), foot.z() + z}, along, lower, upper, height, look);
    };
    const auto body = Look(Material::kGlossy, paint);
    const auto glass = Look(Material::kGlossy, Gray(0.04));
    part(0.0, 0.28, {length, 1.76}, {0.97 * length, 1.70}, van ? 0.75 : 0.55, body);
    if (van) {
      part(-0.1, 1.03, {0.92 * length, 1.68}, {0.86 * length, 1.58}, 0.85, body);
    } else {
      part(-0.2, 0.83, {0.62 * length, 1.62}, {0.40 * length, 1.35}, 0.50, glass);
      part(-0.2, 1.33, {0.40 * length, 1.35}, {0.38 * length, 1.30}, 0.06, body);
    }
    for (const double axle : {-0.31, 0.31}) {
      part(axle * length, 0.0, {0.62, 1.78}, {0.50, 1.78}, 0.5, Look(Material::kPlain, Gray(0.03)));
    }
  }

  void AddLamp(const Vector2d& xy, const Vector2d& inward) {
    const Vector3d foot = OnGround(xy);
    const auto metal = Look(Material::kPlain, Gray(0.22));
    mesh_.AddFrustum(foot, inward, {0.14, 0.14}, {0.09, 0.09}, 6.2, metal);
    const Vector2d head = xy - 0.7 * inward;
    mesh_.AddFrustum(
        {head.x(), head.y(), foot.z() + 6.1}, inward, {1.6, 0.16}, {1.5, 0.1}, 0.12, metal);
  }

  void AddSign(const Vector2d& xy, const Vector2d& along, Random& random) {
    const Vector3d foot = OnGround(xy);
    mesh_.AddFrustum(
        foot, along, {0.07, 0.07}, {0.07, 0.07}, 2.5, Look(Material::kPlain, Gray(0.4)));
    const Vector3f color =
        random.Uniform() < 0.5 ? Vector3f(0.6f, 0.05f, 0.05f) : Vector3f(0.05f, 0.12f, 0.5f);
    mesh_.AddFrustum(foot + Vector3d(0.0, 0.0, 2.1),
                     along,
                     {0.04, 0.6},
                     {0.04, 0.6},
                     0.6,
                     Look(Material::kPlain, color));
  }

  void AddPerson(const Vector2d& xy, Random& random) {
    const Vector3d foot = OnGround(xy);
    const double turn = random.Uniform(0.0, 2.0 * std::numbers::pi);
    const Vector2d along(std::cos(turn), std::sin(turn));
    const auto color = [&] {
      return Vector3f(static_cast<float>(random.Uniform(0.03, 0.6)),
                      static_cast<float>(random.Uniform(0.03, 0.5)),
                      static_cast<float>(random.Uniform(0.03, 0.5)));
    };
    mesh_.AddFrustum(foot, along, {0.25, 0.3}, {0.25, 0.38}, 0.85, Look(Material::kPlain, color()));
    mesh_.AddFrustum(foot + Vector3d(0, 0, 0.85),
                     along,
                     {0.28, 0.42},
                     {0.25, 0.48},
                     0.6,
                     Look(Material::kPlain, color()));
    mesh_.AddFrustum(foot + Vector3d(0, 0, 1.5),
                     along,
                     {0.2, 0.17},
                     {0.18, 0.15},
                     0.24,
                     Look(Material::kPlain, {0.5f, 0.35f, 0.27f}));
  }

  const Town& town_;
  DetailMesh& mesh_;
};

}  // namespace

void AddStreetLife(const Town& town, DetailMesh& mesh) {
  StreetLife life(town, mesh);
  for (std::size_t b = 0; b < town.blocks.size(); ++b) {
    const TownBlock& block = town.blocks[b];
    Random random(static_cast<std::uint64_t>(town.options.seed), kStreetStage, b);
    for (int i = 0; i < 4; ++i) life.AddAlongSide(block.curb[i], block.curb[(i + 1) % 4], random);
    const Vector2d middle = 0.25 * (block.curb[0] + block.curb[1] + block.curb[2] + block.curb[3]);
    for (int i = 0; i < 6; ++i) {
      const Vector2d xy =
          middle + Vector2d(random.Uniform(-16.0, 16.0), random.Uniform(-16.0, 16.0));
      if (!town.InBuilding(xy, 1.5)) life.AddTree(xy, random);
    }
  }
}

}  // namespace ridgeline
