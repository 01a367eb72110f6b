// SPDX-License-Identifier: Apache-2.0
#include "report/inserted_building.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "base/angle.h"

namespace ridgeline {
namespace {

// Rays per pixel in each direction.
constexpr int kSamples = 2;

// Walls, roofs and the rest, BGR.
cv::Vec3f ColorOf(SurfaceClass surface) {
  switch (surface) {
    case SurfaceClass::kRoof:
      return {90.0f, 105.0f, 165.0f};
    case SurfaceClass::kWall:
      return {205.0f, 218.0f, 228.0f};
    default:
      return {190.0f, 195.0f, 200.0f};
  }
}

cv::Vec3f Towards(double azimuth_deg, double elevation_deg) {
  const double level = std::cos(elevation_deg * kRadPerDeg);
  return {static_cast<float>(level * std::sin(azimuth_deg * kRadPerDeg)),
          static_cast<float>(level * std::cos(azimuth_deg * kRadPerDeg)),
          static_cast<float>(std::sin(elevation_deg * kRadPerDeg))};
}

}  // namespace

InsertedPicture InsertBuilding(const cv::Mat& photo,
                               const Scene& city,
                               const Scene& building,
                               const PinholeCamera& camera,
                               const Pose& cam_from_local,
                               const InsertOptions& options) {
  const PinholeCamera fine = camera.Scaled(kSamples);
  const ViewBuffers near = building.Render(fine, cam_from_local, true);
  const ViewBuffers around = city.Render(fine, cam_from_local, false);
  const cv::Vec3f light = Towards(options.light_azimuth_deg, options.light_elevation_deg);

  InsertedPicture result;
  result.picture = photo.clone();
  std::size_t outline = 0, visible = 0;
  for (int y = 0; y < photo.rows; ++y) {
    for (int x = 0; x < photo.cols; ++x) {
      cv::Vec3f color(0.0f, 0.0f, 0.0f);
      int hits = 0;
      for (int k = 0; k < kSamples * kSamples; ++k) {
        const int fy = y * kSamples + k / kSamples, fx = x * kSamples + k % kSamples;
        const float depth = near.depth.at<float>(fy, fx);
        if (!std::isfinite(depth)) continue;
        ++outline;
        if (depth > around.depth.at<float>(fy, fx)) continue;
        ++hits;
        const std::uint32_t surface =
            near.surfaces[static_cast<std::size_t>(fy) * near.depth.cols + fx];
        const float lit = std::max(0.0f, near.normals.at<cv::Vec3f>(fy, fx).dot(light));
        color += (0.55f + 0.45f * lit) * ColorOf(building.model().surfaces[surface].surface_class);
      }
      if (hits == 0) continue;
      visible += static_cast<std::size_t>(hits);
      const float share = static_cast<float>(options.opacity) / (kSamples * kSamples);
      cv::Vec3b& pixel = result.picture.at<cv::Vec3b>(y, x);
      const cv::Vec3f mixed = share * color + (1.0f - share * hits) * cv::Vec3f(pixel);
      for (int c = 0; c < 3; ++c) pixel[c] = cv::saturate_cast<std::uint8_t>(mixed[c]);
    }
  }
  const double rays = static_cast<double>(photo.total()) * kSamples * kSamples;
  result.visible_share = static_cast<double>(visible) / rays;
  if (outline > 0) {
    result.hidden_share = 1.0 - static_cast<double>(visible) / static_cast<double>(outline);
  }
  return result;
}

CityModel PlacedModel(const CityModel& model,
                      const Eigen::Vector3d& base,
                      double heading_deg,
                      double scale) {
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d& v : model.vertices) box.extend(v);
  const Eigen::Vector3d middle(box.center().x(), box.center().y(), box.min().z());
  const Eigen::Matrix3d turn =
      Eigen::AngleAxisd(-heading_deg * kRadPerDeg, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  const auto place = [&](const Eigen::Vector3d& p) -> Eigen::Vector3d {
    return base + scale * (turn * (p - middle));
  };
  CityModel placed = model;
  for (Eigen::Vector3d& v : placed.vertices) v = place(v);
  for (Surface& s : placed.surfaces) s.normal = turn.cast<float>() * s.normal;
  for (FeatureEdge& e : placed.feature_edges) {
    e.a = place(e.a);
    e.b = place(e.b);
  }
  return placed;
}

}  // namespace ridgeline
