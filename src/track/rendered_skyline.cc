// SPDX-License-Identifier: Apache-2.0
#include "track/rendered_skyline.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/angle.h"

namespace ridgeline {
namespace {

constexpr double kViewRad = std::numbers::pi / 3.0;
// Above and below the horizon that a view shows (tangent): skylines of near houses are high.
constexpr double kAbove = 2.2;
constexpr double kBelow = 0.3;

// What is not sky is dark, so that its outline is the upper envelope of the edges.
cv::Mat Drawn(const ViewBuffers& view, const PinholeCamera& camera, const Pose& pose) {
  cv::Mat picture(camera.height, camera.width, CV_8UC3, cv::Scalar(255, 255, 255));
  for (int y = 0; y < picture.rows; ++y) {
    for (int x = 0; x < picture.cols; ++x) {
      const std::size_t i = static_cast<std::size_t>(y) * picture.cols + x;
      // Beyond the model and the terrain the ground goes on to the horizon.
      const bool is_ground = view.surfaces[i] == kNoSurface &&
                             (pose.cam_from_world.conjugate() *
                              camera.RayFromImage({x + 0.5, y + 0.5})).z() < 0.0;
      if (view.surfaces[i] != kNoSurface || is_ground) {
        picture.at<cv::Vec3b>(y, x) = {70, 70, 70};
      }
    }
  }
  return picture;
}

}  // namespace

std::vector<Eigen::Vector3f> RenderedSkyline(const Scene& scene,
                                             const Eigen::Vector3d& position,
                                             const Sector& sector,
                                             double px_per_rad,
                                             const CannySkylineOptions& options) {
  const double width_rad = std::min(2.0 * sector.half_width, 2.0 * std::numbers::pi);
  const int views = std::max(1, static_cast<int>(std::ceil(width_rad / kViewRad)));
  const double view_rad = width_rad / views;
  PinholeCamera camera;
  camera.fx = camera.fy = px_per_rad;
  camera.width = std::max(16, static_cast<int>(std::lround(2.0 * px_per_rad * std::tan(0.5 * view_rad))));
  camera.height = std::max(16, static_cast<int>(std::lround(px_per_rad * (kAbove + kBelow))));
  camera.cx = 0.5 * camera.width;
  camera.cy = px_per_rad * kAbove;
  CannySkylineOptions full = options;
  full.work_width_px = camera.width;  // the images are as fine as they have to be

  std::vector<Eigen::Vector3f> directions;
  for (int v = 0; v < views; ++v) {
    const double azimuth = sector.center - 0.5 * width_rad + (v + 0.5) * view_rad;
    const Pose pose{CamFromWorld(ViewAngles{azimuth * kDegPerRad, 0.0, 0.0}), position};
    const Skyline skyline =
        ExtractCannySkyline(Drawn(scene.Render(camera, pose), camera, pose), full);
    const Eigen::Quaterniond world_from_cam = pose.cam_from_world.conjugate();
    for (std::size_t c = 0; c < skyline.size(); ++c) {
      if (skyline.columns[c] != SkylineColumn::kSeen) continue;
      const Eigen::Vector3d ray = camera.RayFromImage({skyline.XOf(c), skyline.y_px[c]});
      directions.push_back((world_from_cam * ray).normalized().cast<float>());
    }
  }
  return directions;
}

}  // namespace ridgeline
