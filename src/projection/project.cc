// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "projection/scene.h"

namespace ridgeline {
namespace {

constexpr float kNearPlane = 0.1f;  // [m]

// Keeps the parameters in [first, last] where a value going linearly from `at_a` to `at_b` is >= 0.
bool Clip(float at_a, float at_b, float& first, float& last) {
  if (at_a < 0.0f && at_b < 0.0f) return false;
  if (at_a < 0.0f) first = std::max(first, at_a / (at_a - at_b));
  if (at_b < 0.0f) last = std::min(last, at_a / (at_a - at_b));
  return first < last;
}

}  // namespace

void ProjectPieces(const VisibleSet& visible,
                   const PinholeCamera& camera,
                   const Pose& cam_from_local,
                   std::vector<ProjectedSegment>& segments) {
  segments.clear();
  // Homogeneous image points: (x_px * z, y_px * z, z) = image_from_local * (point - center).
  Eigen::Matrix3d calibration;
  calibration << camera.fx, 0.0, camera.cx, 0.0, camera.fy, camera.cy, 0.0, 0.0, 1.0;
  const Eigen::Matrix3f image_from_local =
      (calibration * cam_from_local.cam_from_world.toRotationMatrix()).cast<float>();
  const Eigen::Vector3f center = cam_from_local.center_in_world.cast<float>();
  const auto width = static_cast<float>(camera.width);
  const auto height = static_cast<float>(camera.height);
  for (std::size_t i = 0; i < visible.pieces.size(); ++i) {
    const Eigen::Vector3f a = image_from_local * (visible.pieces[i].a - center);
    const Eigen::Vector3f b = image_from_local * (visible.pieces[i].b - center);
    float first = 0.0f;
    float last = 1.0f;
    // The five planes are linear in the homogeneous point: near, left, right, top, bottom.
    if (!Clip(a.z() - kNearPlane, b.z() - kNearPlane, first, last) ||
        !Clip(a.x(), b.x(), first, last) ||
        !Clip(width * a.z() - a.x(), width * b.z() - b.x(), first, last) ||
        !Clip(a.y(), b.y(), first, last) ||
        !Clip(height * a.z() - a.y(), height * b.z() - b.y(), first, last)) {
      continue;
    }
    const Eigen::Vector3f start = a + first * (b - a);
    const Eigen::Vector3f end = a + last * (b - a);
    segments.push_back({start.head<2>() / start.z(),
                        end.head<2>() / end.z(),
                        static_cast<std::uint32_t>(i),
                        0.5f * (start.z() + end.z()),
                        1.0f / start.z(),
                        1.0f / end.z()});
  }
}

}  // namespace ridgeline
