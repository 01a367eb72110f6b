// SPDX-License-Identifier: Apache-2.0
#include "score/tilted_rays.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace ridgeline {
namespace {

// Of the images of the vertical: rotations are computed in doubles.
constexpr float kSameTilt = 1e-5f;

}  // namespace

TiltedRays::TiltedRays(std::span<const Eigen::Vector3f> rays,
                       std::span<const Eigen::Matrix3f> cam_from_level) {
  for (const Eigen::Matrix3f& rotation : cam_from_level) {
    Tilt tilt{rotation, {}};
    tilt.directions.resize((rays.size() + 3) / 4);
    for (std::size_t i = 0; i < 4 * tilt.directions.size(); ++i) {
      const Eigen::Vector3d level =
          (rotation.transpose() * rays[std::min(i, rays.size() - 1)]).cast<double>();
      auto azimuth = static_cast<float>(std::atan2(level.x(), level.y()));
      if (azimuth < 0.0f) azimuth += kTurn;
      tilt.directions[i / 4].azimuth[i % 4] = azimuth < kTurn ? azimuth : 0.0f;
      tilt.directions[i / 4].elevation[i % 4] =
          static_cast<float>(std::atan2(level.z(), std::hypot(level.x(), level.y())));
    }
    tilts_.push_back(std::move(tilt));
  }
}

std::optional<TiltedRays::Turned> TiltedRays::Find(const Eigen::Matrix3f& cam_from_local) const {
  for (std::size_t i = 0; i < tilts_.size(); ++i) {
    const Eigen::Matrix3f& tilt = tilts_[i].cam_from_level;
    if ((tilt.col(2) - cam_from_local.col(2)).cwiseAbs().maxCoeff() > kSameTilt) continue;
    // tilt^T cam_from_local: the columns are east and north as right, ahead and up.
    const float ahead = tilt.col(1).dot(cam_from_local.col(0));
    const float right = tilt.col(0).dot(cam_from_local.col(0));
    return Turned{i, std::atan2(ahead, right)};
  }
  return std::nullopt;
}

float TiltedRays::Shift(const SurfacePanorama& panorama, float heading) {
  constexpr double kTurnExact = 2.0 * std::numbers::pi;
  double angle =
      std::fmod(heading - panorama.first_azimuth + 0.5 * panorama.step, kTurnExact);
  if (angle < 0.0) angle += kTurnExact;
  return static_cast<float>(angle / panorama.step);
}

}  // namespace ridgeline
