// SPDX-License-Identifier: Apache-2.0
#include "projection/beside.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "projection/triangle_edges.h"

namespace ridgeline {
namespace {

// How far beside the edge the rays pass: as an angle [rad], but at least this far [m], so that they
// do not hit the edge's own faces by rounding.
constexpr float kOffsetAngle = 1.5e-3f;
constexpr float kLeastOffset = 0.05f;
// Pieces longer than this are looked at in three places [rad].
constexpr float kLongPiece = 0.03f;

// Unit vector to the left of the direction `along` as seen from the eye, up being up.
Eigen::Vector3f LeftOf(const Eigen::Vector3f& along, const Eigen::Vector3f& point) {
  return along.cross(point).normalized();
}

// Whether face 0 of a fold that shows both faces lies to the left.
bool Face0IsLeft(const SceneEdge& edge, const Eigen::Vector3f& left) {
  // From the edge into face 0, across the edge: away from the other face's normal if convex.
  const float cosine = edge.normal0.dot(edge.normal1);
  const Eigen::Vector3f into = cosine * edge.normal0 - edge.normal1;
  return (edge.concave ? -into : into).dot(left) > 0.0f;
}

}  // namespace

BesideFinder::BesideFinder(const CityModel& model, const RayScene& rays)
    : model_(model), rays_(rays), roots_(RootBuildings(model)) {}

Beside BesideFinder::OwnFace(std::uint32_t surface) const {
  const Surface& face = model_.surfaces[surface];
  switch (face.surface_class) {
    case SurfaceClass::kRoof:
      return Beside::kOwnRoof;
    case SurfaceClass::kWall:
    case SurfaceClass::kGround:
    case SurfaceClass::kClosure:
      return Beside::kOwnWall;
    case SurfaceClass::kTerrain:
      return Beside::kGround;
    case SurfaceClass::kOther:
      break;
  }
  // Not told by the model: steep faces are walls.
  return std::abs(face.normal.z()) < 0.5f ? Beside::kOwnWall : Beside::kOwnRoof;
}

Beside BesideFinder::Look(const Eigen::Vector3f& eye,
                          const FeatureEdge& feature,
                          const Eigen::Vector3f& point,
                          const Eigen::Vector3f& aside) const {
  const float offset = std::max(kLeastOffset, kOffsetAngle * point.norm());
  const Eigen::Vector3f direction = point + offset * aside;
  const std::optional<RayHit> hit = rays_.Cast(eye, direction);
  if (!hit) return direction.z() < 0.0f ? Beside::kGround : Beside::kSky;
  if (hit->surface == kTerrainSurface) return Beside::kGround;
  const std::uint32_t root = roots_[model_.surfaces[hit->surface].building];
  for (const std::uint32_t own : {feature.surface0, feature.surface1}) {
    if (own != kNoSurface && roots_[model_.surfaces[own].building] == root) {
      return OwnFace(hit->surface);
    }
  }
  return Beside::kOtherBuilding;
}

std::pair<Beside, Beside> BesideFinder::Find(const Eigen::Vector3f& eye,
                                             const SceneEdge& edge,
                                             const FeatureEdge& feature,
                                             const Eigen::Vector3f& a,
                                             const Eigen::Vector3f& b) const {
  const Eigen::Vector3f along = b - a;
  const Eigen::Vector3f middle = 0.5f * (a + b);
  const Facing facing = FacingOf(edge, eye);
  std::optional<Beside> left, right;
  if (edge.known && facing.front0 && facing.front1) {
    const bool is_left = Face0IsLeft(edge, LeftOf(along, middle));
    left = OwnFace(is_left ? feature.surface0 : feature.surface1);
    right = OwnFace(is_left ? feature.surface1 : feature.surface0);
    return {*left, *right};
  }
  const auto majority = [&](float sign) {
    const auto look = [&](float t) {
      const Eigen::Vector3f point = a + t * along;
      return Look(eye, feature, point, sign * LeftOf(along, point));
    };
    const Beside center = look(0.5f);
    if (along.norm() < kLongPiece * middle.norm()) return center;
    const Beside near_a = look(1.0f / 6.0f);
    return near_a != center && near_a == look(5.0f / 6.0f) ? near_a : center;
  };
  return {majority(1.0f), majority(-1.0f)};
}

}  // namespace ridgeline
