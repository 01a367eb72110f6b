// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <string>
#include <vector>

namespace ridgeline {

// Pinhole camera: x_px = fx * X / Z + cx, y_px = fy * Y / Z + cy, with camera axes x right, y down,
// z forward. Pixel (0, 0) is the upper left corner of the upper left pixel, as in COLMAP.
struct PinholeCamera {
  int width = 0;
  int height = 0;
  double fx = 0.0;
  double fy = 0.0;
  double cx = 0.0;
  double cy = 0.0;

  // Image point [px] of a point in camera axes; z must be > 0.
  Eigen::Vector2d ImageFromCamera(const Eigen::Vector3d& point_in_camera) const {
    return {fx * point_in_camera.x() / point_in_camera.z() + cx,
            fy * point_in_camera.y() / point_in_camera.z() + cy};
  }
  // Ray in camera axes through an image point [px], with z = 1.
  Eigen::Vector3d RayFromImage(const Eigen::Vector2d& px) const {
    return {(px.x() - cx) / fx, (px.y() - cy) / fy, 1.0};
  }
  // The same camera for an image resampled by `scale` (the size is rounded, the axes scaled to it).
  PinholeCamera Scaled(double scale) const;
};

// A COLMAP camera: model name and its parameters in COLMAP's order. Supported: SIMPLE_PINHOLE
// (f, cx, cy), PINHOLE (fx, fy, cx, cy), SIMPLE_RADIAL (f, cx, cy, k), RADIAL (f, cx, cy, k1, k2),
// OPENCV (fx, fy, cx, cy, k1, k2, p1, p2), FULL_OPENCV (those and k3, k4, k5, k6).
// Source: COLMAP, src/colmap/sensor/models.h.
struct CameraIntrinsics {
  std::string model = "PINHOLE";
  int width = 0;
  int height = 0;
  std::vector<double> params;

  // Throws InputError(file, field + ".model" etc.) for an unknown model, a wrong number of
  // parameters, non-finite values, sizes that are not positive, or a focal length whose field of
  // view is not one of 5 to 150 degrees across the diagonal (with what it may mean, such as mm).
  void Validate(const std::string& file, const std::string& field) const;
  bool HasDistortion() const;
  // The linear part.
  PinholeCamera Pinhole() const;
  // Distorted image point [px] of a ray (x / z, y / z) in camera axes.
  Eigen::Vector2d Distort(const Eigen::Vector2d& normalized) const;
  // Ray (x / z, y / z) of a distorted image point [px]; fixed-point iteration to 1e-10.
  Eigen::Vector2d Undistort(const Eigen::Vector2d& px) const;
};

// The picture resampled so that camera.Pinhole() describes it; the input itself without distortion.
cv::Mat UndistortImage(const cv::Mat& image, const CameraIntrinsics& camera);

}  // namespace ridgeline
