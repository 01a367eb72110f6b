// SPDX-License-Identifier: Apache-2.0
#include "synth/viewpoint.h"

#include <cmath>
#include <utility>

#include "base/angle.h"

namespace ridgeline {
namespace {

using Eigen::Vector2d;

CameraIntrinsics DrawCamera(int width, int height, double hfov_deg, Random& random) {
  const double focal = 0.5 * width / std::tan(0.5 * hfov_deg / kDegPerRad);
  CameraIntrinsics camera;
  camera.width = width;
  camera.height = height;
  camera.params = {focal,
                   focal,
                   0.5 * width + random.Uniform(-4.0, 4.0),
                   0.5 * height + random.Uniform(-4.0, 4.0)};
  for (double& value : camera.params) value = std::round(value * 100.0) / 100.0;
  return camera;
}

// A point on a street of the town and the street's direction.
std::pair<Vector2d, Vector2d> DrawStreetPoint(const Town& town, Random& random) {
  const TownBlock& block = town.blocks[random.Below(town.blocks.size())];
  const auto side = static_cast<std::size_t>(random.Below(4));
  const Vector2d start = block.curb[side];
  const Vector2d end = block.curb[(side + 1) % 4];
  const Vector2d along = (end - start).normalized();
  const Vector2d inward(-along.y(), along.x());
  const Vector2d point =
      start + random.Uniform(0.05, 0.95) * (end - start) + random.Uniform(-7.0, 2.0) * inward;
  return {point, along};
}

CameraIntrinsics CameraFor(ViewKind kind, const ViewCamera& camera, int seed, Random& random) {
  constexpr std::uint64_t kCameraStage = 0x82;
  const bool portrait = kind == ViewKind::kPortrait;
  const int width = portrait ? camera.height : camera.width;
  const int height = portrait ? camera.width : camera.height;
  Random once(static_cast<std::uint64_t>(seed), kCameraStage);
  Random& drawn = camera.same_for_all ? once : random;
  const double hfov_deg = portrait ? drawn.Uniform(48.0, 56.0) : drawn.Uniform(55.0, 68.0);
  return DrawCamera(width, height, hfov_deg, drawn);
}

Viewpoint Draw(const Town& town, ViewKind kind, const ViewCamera& camera, Random& random) {
  const bool drone = IsFromTheAir(kind);
  const auto [point, along] = DrawStreetPoint(town, random);
  const double street_deg = std::atan2(along.x(), along.y()) * kDegPerRad;
  ViewAngles angles;
  // Mostly along the street, sometimes across it; drones look anywhere.
  const bool lengthwise = random.Uniform() < 0.65;
  angles.heading_deg = drone ? random.Uniform(0.0, 360.0)
                       : lengthwise
                           ? street_deg + 180.0 * random.Below(2) + random.Uniform(-35.0, 35.0)
                           : street_deg + 90.0 + random.Uniform(-40.0, 40.0);
  angles.heading_deg = WrapHeadingDeg(angles.heading_deg);
  double above_m = random.Uniform(1.6, 1.8);
  switch (kind) {
    case ViewKind::kStreet:
    case ViewKind::kPortrait:
      angles.pitch_deg = random.Uniform(-1.0, 5.0);
      angles.roll_deg = random.Uniform(-2.0, 2.0);
      break;
    case ViewKind::kTilted:
      angles.pitch_deg = random.Uniform(7.0, 18.0);
      angles.roll_deg = random.Uniform(-4.5, 4.5);
      break;
    case ViewKind::kDrone:
      angles.pitch_deg = random.Uniform(-45.0, -25.0);
      angles.roll_deg = random.Uniform(-2.0, 2.0);
      above_m = random.Uniform(40.0, 60.0);
      break;
    case ViewKind::kLow:
      angles.pitch_deg = random.Uniform(-50.0, -5.0);
      angles.roll_deg = random.Uniform(-2.0, 2.0);
      above_m = random.Uniform(10.0, 40.0);
      break;
    case ViewKind::kNadir:
      angles.pitch_deg = random.Uniform(-89.5, -80.0);
      angles.roll_deg = random.Uniform(-2.0, 2.0);
      above_m = random.Uniform(25.0, 60.0);
      break;
  }
  Viewpoint view;
  view.camera = CameraFor(kind, camera, town.options.seed, random);
  view.cam_from_local.cam_from_world = CamFromWorld(angles);
  view.cam_from_local.center_in_world =
      Eigen::Vector3d(point.x(), point.y(), town.TerrainHeight(point) + above_m);
  return view;
}

bool IsGood(const Town& town, const Viewpoint& view, const ViewStatistics& seen, ViewKind kind) {
  const Vector2d xy = view.cam_from_local.center_in_world.head<2>();
  if (kind == ViewKind::kDrone) return seen.building_share > 0.35 && seen.buildings >= 4;
  // Lower ones must not be in a roof, and see less at once.
  if (kind == ViewKind::kLow || kind == ViewKind::kNadir) {
    return !town.InBuilding(xy, 1.0) && seen.building_share > 0.3 && seen.buildings >= 2 &&
           seen.nearest_m > 4.0;
  }
  return !town.InBuilding(xy, 0.7) && seen.building_share > 0.2 && seen.buildings >= 3 &&
         seen.skyline_share > 0.6 && seen.sky_share < 0.6 && seen.nearest_m > 3.0 &&
         seen.median_building_m > 12.0;
}

}  // namespace

const char* ViewKindName(ViewKind kind) {
  switch (kind) {
    case ViewKind::kStreet:
      return "street";
    case ViewKind::kTilted:
      return "tilted";
    case ViewKind::kPortrait:
      return "portrait";
    case ViewKind::kDrone:
      return "drone";
    case ViewKind::kLow:
      return "low";
    case ViewKind::kNadir:
      return "nadir";
  }
  return "";
}

bool IsFromTheAir(ViewKind kind) {
  return kind == ViewKind::kDrone || kind == ViewKind::kLow || kind == ViewKind::kNadir;
}

Viewpoint DrawViewpoint(const Town& town,
                        const TownRenderer& renderer,
                        ViewKind kind,
                        const ViewCamera& camera,
                        Random& random) {
  for (;;) {
    const Viewpoint view = Draw(town, kind, camera, random);
    const ViewStatistics seen = renderer.Probe(view.camera, view.cam_from_local);
    if (IsGood(town, view, seen, kind)) return view;
  }
}

}  // namespace ridgeline
