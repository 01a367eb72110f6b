// SPDX-License-Identifier: Apache-2.0
#include "track/skyline_shift.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/angle.h"
#include "skyline/clean_skyline.h"

namespace ridgeline {
namespace {

// Directions farther than this from the optical axis are not drawn (cosine).
constexpr float kMinZ = 0.2f;

}  // namespace

SkylineDrawing::SkylineDrawing(std::span<const Eigen::Vector3f> directions,
                               const PinholeCamera& camera,
                               const Eigen::Quaterniond& cam_from_world,
                               double precision_px)
    : principal_point_(static_cast<float>(camera.cx), static_cast<float>(camera.cy)) {
  const Eigen::Matrix3f rotation = cam_from_world.toRotationMatrix().cast<float>();
  Polyline line;
  for (const Eigen::Vector3f& direction : directions) {
    const Eigen::Vector3f p = rotation * direction;
    if (p.z() < kMinZ) continue;
    line.emplace_back(camera.fx * p.x() / p.z(), camera.fy * p.y() / p.z());
  }
  for (const Eigen::Vector2d& p : SimplifyPolyline(line, precision_px)) {
    points_.push_back(p.cast<float>());
  }
}

void SkylineDrawing::Rows(const Motion& motion, std::span<float> rows) const {
  std::fill(rows.begin(), rows.end(), std::numeric_limits<float>::quiet_NaN());
  const float c = static_cast<float>(std::cos(motion.turn_rad));
  const float s = static_cast<float>(std::sin(motion.turn_rad));
  const Eigen::Vector2f to = principal_point_ + Eigen::Vector2f(static_cast<float>(motion.x_px),
                                                                static_cast<float>(motion.y_px));
  const auto moved = [&](const Eigen::Vector2f& p) {
    return Eigen::Vector2f(c * p.x() - s * p.y() + to.x(), s * p.x() + c * p.y() + to.y());
  };
  const int columns = static_cast<int>(rows.size());
  for (std::size_t i = 1; i < points_.size(); ++i) {
    const Eigen::Vector2f a = moved(points_[i - 1]);
    const Eigen::Vector2f b = moved(points_[i]);
    if (b.x() <= a.x() || b.x() < 0.0f || a.x() > static_cast<float>(columns)) continue;
    const int first = std::max(0, static_cast<int>(std::ceil(a.x() - 0.5f)));
    const int last = std::min(columns - 1, static_cast<int>(std::floor(b.x() - 0.5f)));
    const float slope = (b.y() - a.y()) / (b.x() - a.x());
    for (int k = first; k <= last; ++k) {
      rows[static_cast<std::size_t>(k)] = a.y() + slope * (static_cast<float>(k) + 0.5f - a.x());
    }
  }
}

Eigen::Quaterniond RotationAfter(const SkylineDrawing::Motion& motion,
                                 const PinholeCamera& camera,
                                 const Eigen::Quaterniond& cam_from_world) {
  // The old optical axis appears at the principal point moved by the shift.
  const double across = std::atan(motion.x_px / camera.fx);
  const double down = std::atan(motion.y_px / camera.fy * std::cos(across));
  return Eigen::AngleAxisd(across, Eigen::Vector3d::UnitY()) *
         Eigen::AngleAxisd(-down, Eigen::Vector3d::UnitX()) *
         Eigen::AngleAxisd(motion.turn_rad, Eigen::Vector3d::UnitZ()) * cam_from_world;
}

Eigen::Quaterniond RotationAfterLinear(const SkylineDrawing::Motion& motion,
                                       const PinholeCamera& camera,
                                       const Eigen::Quaterniond& cam_from_world) {
  const double fov_x = 2.0 * std::atan(0.5 * camera.width / camera.fx);
  const double fov_y = 2.0 * std::atan(0.5 * camera.height / camera.fy);
  ViewAngles angles = ViewAnglesOf(cam_from_world);
  angles.heading_deg -= motion.x_px * fov_x / camera.width * kDegPerRad;
  angles.pitch_deg += motion.y_px * fov_y / camera.height * kDegPerRad;
  angles.roll_deg -= motion.turn_rad * kDegPerRad;
  return CamFromWorld(angles);
}

}  // namespace ridgeline
