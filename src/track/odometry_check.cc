// SPDX-License-Identifier: Apache-2.0
#include "track/odometry_check.h"

#include <algorithm>
#include <cmath>

namespace ridgeline {
namespace {

constexpr std::size_t kMostPlaces = 12;
constexpr double kLeastWayM = 2.0;
constexpr double kTurnDeg = 6.0;
constexpr int kLeastPlaces = 5;

Eigen::Matrix3d CameraFrom(OdometryAxes axes) {
  Eigen::Matrix3d m = Eigen::Matrix3d::Identity();
  if (axes == OdometryAxes::kBody) m << 0, -1, 0, 0, 0, -1, 1, 0, 0;
  if (axes == OdometryAxes::kPhoto) m << 1, 0, 0, 0, -1, 0, 0, 0, -1;
  return m;
}

// From one place to a later one.
Motion Between(const Motion& first, const Motion& second) {
  Motion motion;
  motion.now_from_before = second.now_from_before * first.now_from_before.conjugate();
  motion.step_in_before = first.now_from_before * (second.step_in_before - first.step_in_before);
  return motion;
}

bool IsSameStep(const Eigen::Vector3d& odometry, const Eigen::Vector3d& found) {
  return (found - odometry).norm() <= 0.5 + 0.1 * found.norm();
}

// The scale at which the odometry's step is the one found; nullopt: it points elsewhere.
std::optional<double> ScaleOf(const Motion& odometry, const Motion& found) {
  if (RotationDistanceDeg(odometry.now_from_before, found.now_from_before) > kTurnDeg) {
    return std::nullopt;
  }
  const double length = odometry.step_in_before.norm();
  if (length < 1e-6 || found.step_in_before.norm() < kLeastWayM) return std::nullopt;
  const double scale =
      odometry.step_in_before.dot(found.step_in_before) / (length * length);
  if (scale <= 0.0 || !IsSameStep(scale * odometry.step_in_before, found.step_in_before)) {
    return std::nullopt;
  }
  return scale;
}

}  // namespace

const char* NameOf(OdometryAxes axes) {
  switch (axes) {
    case OdometryAxes::kCamera:
      return "camera";
    case OdometryAxes::kBody:
      return "body";
    case OdometryAxes::kPhoto:
      return "photo";
  }
  return "";
}

Motion InCameraAxes(const Motion& motion, OdometryAxes axes) {
  const Eigen::Matrix3d camera_from = CameraFrom(axes);
  Motion turned = motion;
  turned.step_in_before = camera_from * motion.step_in_before;
  turned.now_from_before = Eigen::Quaterniond(
      camera_from * motion.now_from_before.toRotationMatrix() * camera_from.transpose());
  return turned;
}

void OdometryCheck::Add(const std::optional<Motion>& motion) {
  if (!motion) {
    places_.clear();
    from_first_ = {};
    return;
  }
  from_first_ = Composed(from_first_, *motion);
}

void OdometryCheck::Add(const Pose& found) {
  places_.push_back({from_first_, found});
  if (places_.size() > kMostPlaces) places_.erase(places_.begin());
}

int OdometryCheck::Agreeing(std::size_t from, OdometryAxes axes, double scale) const {
  int count = 0;
  for (const Place& place : places_) {
    const Motion odometry = InCameraAxes(Between(places_[from].from_first, place.from_first), axes);
    const Motion found = MotionBetween(places_[from].found, place.found);
    count += RotationDistanceDeg(odometry.now_from_before, found.now_from_before) <= kTurnDeg &&
                     IsSameStep(scale * odometry.step_in_before, found.step_in_before)
                 ? 1
                 : 0;
  }
  return count;
}

std::optional<OdometryCheck::Finding> OdometryCheck::Find(bool scale_is_guessed) const {
  Finding best;
  int as_it_is = 0;
  for (std::size_t i = 0; i < places_.size(); ++i) {
    as_it_is = std::max(as_it_is, Agreeing(i, OdometryAxes::kCamera, 1.0));
  }
  for (const OdometryAxes axes : kOdometryAxes) {
    for (std::size_t i = 0; i < places_.size(); ++i) {
      for (std::size_t j = i + 1; j < places_.size(); ++j) {
        const Motion odometry =
            InCameraAxes(Between(places_[i].from_first, places_[j].from_first), axes);
        const auto scale = ScaleOf(odometry, MotionBetween(places_[i].found, places_[j].found));
        if (!scale) continue;
        const int agreeing = Agreeing(i, axes, *scale);
        if (agreeing > best.agreeing) best = {axes, *scale, agreeing};
      }
    }
  }
  if (best.agreeing < kLeastPlaces || (!scale_is_guessed && best.agreeing < 2 * as_it_is)) {
    return std::nullopt;
  }
  return best;
}

}  // namespace ridgeline
