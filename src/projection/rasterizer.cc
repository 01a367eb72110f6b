// SPDX-License-Identifier: Apache-2.0
#include "projection/rasterizer.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace ridgeline {
namespace {

constexpr double kNearPlaneM = 0.1;  // [m]

// Convex polygon in homogeneous image points (x_px * z, y_px * z, z); a clipped triangle has four.
struct Polygon {
  std::array<Eigen::Vector3d, 4> corners;
  int count = 0;

  void Add(const Eigen::Vector3d& corner) { corners[count++] = corner; }
};

// The part of a triangle before the near plane.
Polygon ClipNear(const std::array<Eigen::Vector3d, 3>& triangle) {
  Polygon polygon;
  for (int k = 0; k < 3; ++k) {
    const Eigen::Vector3d& a = triangle[k];
    const Eigen::Vector3d& b = triangle[(k + 1) % 3];
    const double da = a.z() - kNearPlaneM;
    const double db = b.z() - kNearPlaneM;
    if (da >= 0.0) polygon.Add(a);
    if ((da >= 0.0) != (db >= 0.0)) polygon.Add(a + da / (da - db) * (b - a));
  }
  return polygon;
}

// Smallest and largest x of a polygon on a horizontal line; empty: first > last.
struct Span {
  double first = std::numeric_limits<double>::infinity();
  double last = -std::numeric_limits<double>::infinity();
};

Span SpanAt(const std::array<Eigen::Vector2d, 4>& points, int count, double y) {
  Span span;
  for (int k = 0; k < count; ++k) {
    const Eigen::Vector2d& a = points[k];
    const Eigen::Vector2d& b = points[(k + 1) % count];
    if ((a.y() <= y) == (b.y() <= y)) continue;
    const double x = a.x() + (y - a.y()) / (b.y() - a.y()) * (b.x() - a.x());
    span.first = std::min(span.first, x);
    span.last = std::max(span.last, x);
  }
  return span;
}

void RasterizePolygon(const Polygon& polygon, cv::Mat& depth) {
  std::array<Eigen::Vector2d, 4> points;
  double top = std::numeric_limits<double>::infinity();
  double bottom = -std::numeric_limits<double>::infinity();
  for (int k = 0; k < polygon.count; ++k) {
    points[k] = polygon.corners[k].head<2>() / polygon.corners[k].z();
    top = std::min(top, points[k].y());
    bottom = std::max(bottom, points[k].y());
  }
  // The plane n * p = offset in homogeneous image points gives 1 / z = n * (x, y, 1) / offset.
  const Eigen::Vector3d normal =
      (polygon.corners[1] - polygon.corners[0]).cross(polygon.corners[2] - polygon.corners[0]);
  const double offset = normal.dot(polygon.corners[0]);
  if (offset == 0.0 || !std::isfinite(offset)) return;  // edge-on or degenerate
  const Eigen::Vector3d inverse_depth = normal / offset;
  const int first_row = std::max(0, static_cast<int>(std::ceil(std::max(top, 0.0) - 0.5)));
  const int last_row =
      static_cast<int>(std::floor(std::min(bottom, static_cast<double>(depth.rows)) - 0.5));
  for (int row = first_row; row <= last_row; ++row) {
    const Span span = SpanAt(points, polygon.count, row + 0.5);
    if (span.first > span.last) continue;
    const int first = static_cast<int>(std::ceil(std::max(span.first, 0.0) - 0.5));
    const int last =
        static_cast<int>(std::floor(std::min(span.last, static_cast<double>(depth.cols)) - 0.5));
    float* const line = depth.ptr<float>(row);
    for (int column = std::max(first, 0); column <= last; ++column) {
      const double inverse =
          inverse_depth.x() * (column + 0.5) + inverse_depth.y() * (row + 0.5) + inverse_depth.z();
      if (inverse > 0.0) line[column] = std::min(line[column], static_cast<float>(1.0 / inverse));
    }
  }
}

}  // namespace

cv::Mat RasterizeDepth(const CityModel& model,
                       const PinholeCamera& camera,
                       const Pose& cam_from_local,
                       double radius_m) {
  cv::Mat depth(
      camera.height, camera.width, CV_32F, cv::Scalar(std::numeric_limits<float>::infinity()));
  Eigen::Matrix3d calibration;
  calibration << camera.fx, 0.0, camera.cx, 0.0, camera.fy, camera.cy, 0.0, 0.0, 1.0;
  const Eigen::Matrix3d image_from_local =
      calibration * cam_from_local.cam_from_world.toRotationMatrix();
  for (const Triangle& triangle : model.triangles) {
    std::array<Eigen::Vector3d, 3> corners;
    bool is_near = false;
    for (int k = 0; k < 3; ++k) {
      corners[k] = model.vertices[triangle.vertices[k]] - cam_from_local.center_in_world;
      is_near = is_near || corners[k].head<2>().cwiseAbs().maxCoeff() <= radius_m;
    }
    if (!is_near) continue;
    for (Eigen::Vector3d& corner : corners) corner = image_from_local * corner;
    const Polygon polygon = ClipNear(corners);
    if (polygon.count >= 3) RasterizePolygon(polygon, depth);
  }
  return depth;
}

}  // namespace ridgeline
