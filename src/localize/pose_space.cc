// SPDX-License-Identifier: Apache-2.0
#include "localize/pose_space.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"

namespace ridgeline {
namespace {

// A camera below this height over the ground of the terrain model is under ground for certain.
constexpr double kMinHeightAboveTerrain = 0.2;

}  // namespace

PoseSpace::PoseSpace(const PosePrior& prior,
                     const PoseSpaceOptions& options,
                     const Scene& scene,
                     const HeightGrid* dtm,
                     const Footprints& footprints)
    : ranges_(options),
      scene_(&scene),
      dtm_(dtm),
      footprints_(&footprints),
      center_(prior.position_in_world - scene.model().origin_in_world.head<2>()) {
  const double sum = prior.position_in_world.sum() + prior.height_in_world.value_or(0.0) +
                     prior.heading_deg.value_or(0.0) + prior.pitch_deg.value_or(0.0) +
                     prior.roll_deg.value_or(0.0);
  if (!std::isfinite(sum)) throw InputError("", "prior", "a value that is not finite", "numbers");
  angles_ = {prior.heading_deg.value_or(0.0),
             prior.pitch_deg.value_or(0.0),
             prior.roll_deg.value_or(0.0)};
  if (!prior.heading_deg) ranges_.heading_deg = 180.0;
  if (prior.height_in_world) {
    height_ = *prior.height_in_world - scene.model().origin_in_world.z();
    return;
  }
  ranges_.height_m = std::max(ranges_.height_m, ranges_.camera_height_range_m);
  if (dtm_ == nullptr) {
    throw InputError("", "prior.position", "no height and no DTM", "a height or --dtm");
  }
  if (!dtm_->HeightAt(center_)) {
    throw InputError("", "prior.position", "a place the DTM does not cover", "a place on the DTM");
  }
}

PoseSpace PoseSpace::MovedTo(const Offset& offset) const {
  PoseSpace moved = *this;
  moved.center_ += Eigen::Vector2d(offset.east_m, offset.north_m);
  if (moved.height_) *moved.height_ += offset.height_m;
  moved.angles_ = AnglesAt(offset);
  return moved;
}

std::optional<Eigen::Vector3d> PoseSpace::PositionAt(double east_m,
                                                     double north_m,
                                                     double height_m) const {
  const Eigen::Vector2d xy = center_ + Eigen::Vector2d(east_m, north_m);
  std::optional<double> ground;
  if (dtm_ != nullptr) ground = dtm_->HeightAt(xy);
  if (!height_ && !ground) return std::nullopt;
  const double z = (height_ ? *height_ : *ground + ranges_.camera_height_m) + height_m;
  if (ranges_.free_space) {
    if (dtm_ != nullptr && !ground) return std::nullopt;
    if (ground && z < *ground + kMinHeightAboveTerrain) return std::nullopt;
    if (IsInBuilding({xy.x(), xy.y(), z})) return std::nullopt;
  }
  return Eigen::Vector3d(xy.x(), xy.y(), z);
}

std::optional<double> PoseSpace::SameHeightAboveGround(double east_m, double north_m) const {
  if (!height_ || dtm_ == nullptr) return 0.0;
  const std::optional<double> here = dtm_->HeightAt(center_);
  const std::optional<double> there = dtm_->HeightAt(center_ + Eigen::Vector2d(east_m, north_m));
  if (!here || !there) return std::nullopt;
  return *there - *here;
}

// Above a footprint is not inside it: a drone has no roof over it.
bool PoseSpace::IsInBuilding(const Eigen::Vector3d& position) const {
  return footprints_->Contains(position.head<2>()) &&
         scene_->Raycast(position, Eigen::Vector3d::UnitZ()).has_value();
}

ViewAngles PoseSpace::AnglesAt(const Offset& offset) const {
  return {WrapHeadingDeg(angles_.heading_deg + offset.heading_deg),
          angles_.pitch_deg + offset.pitch_deg,
          angles_.roll_deg + offset.roll_deg};
}

double PoseSpace::LogPrior(const Offset& offset) const {
  const double tilt = std::hypot(offset.pitch_deg, offset.roll_deg) / ranges_.tilt_scale_deg;
  const double of_tilt = -1.5 * std::log1p(tilt * tilt);  // Cauchy in two dimensions
  if (height_ || ranges_.camera_height_range_m <= 0.0) return of_tilt;
  // A camera in the hand, over a terrain that may err: Student's t of four degrees of freedom.
  const double height = offset.height_m / ranges_.camera_height_range_m;
  return of_tilt - 2.5 * std::log1p(height * height / 4.0);
}

std::optional<Pose> PoseSpace::PoseAt(const Offset& offset) const {
  const auto position = PositionAt(offset.east_m, offset.north_m, offset.height_m);
  if (!position) return std::nullopt;
  return Pose{CamFromWorld(AnglesAt(offset)), *position};
}

double DistanceM(const PoseSpace::Offset& a, const PoseSpace::Offset& b) {
  return Eigen::Vector3d(a.east_m - b.east_m, a.north_m - b.north_m, a.height_m - b.height_m).norm();
}

double AngleDeg(const PoseSpace::Offset& a, const PoseSpace::Offset& b) {
  return Eigen::Vector3d(HeadingDifferenceDeg(a.heading_deg, b.heading_deg),
                         a.pitch_deg - b.pitch_deg,
                         a.roll_deg - b.roll_deg)
      .norm();
}

}  // namespace ridgeline
