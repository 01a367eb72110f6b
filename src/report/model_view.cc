// SPDX-License-Identifier: Apache-2.0
#include "report/model_view.h"

#include <algorithm>
#include <cmath>

namespace ridgeline {
namespace {

cv::Vec3f ColorOf(std::uint32_t surface, const CityModel& model) {
  if (surface == kTerrainSurface) return {110.0f, 150.0f, 125.0f};  // BGR
  switch (model.surfaces[surface].surface_class) {
    case SurfaceClass::kRoof:
      return {90.0f, 100.0f, 205.0f};
    case SurfaceClass::kWall:
      return {205.0f, 212.0f, 216.0f};
    default:
      return {170.0f, 170.0f, 150.0f};
  }
}

}  // namespace

cv::Mat DepthPicture(const ViewBuffers& view) {
  cv::Mat picture(view.depth.size(), CV_16U);
  for (int y = 0; y < picture.rows; ++y) {
    for (int x = 0; x < picture.cols; ++x) {
      const float depth = view.depth.at<float>(y, x);
      picture.at<std::uint16_t>(y, x) =
          std::isfinite(depth)
              ? static_cast<std::uint16_t>(std::clamp(std::lround(100.0f * depth), 1L, 65535L))
              : 0;
    }
  }
  return picture;
}

cv::Mat IdPicture(const ViewBuffers& view) {
  cv::Mat picture(view.depth.size(), CV_8UC3, cv::Scalar(0, 0, 0));
  for (int y = 0; y < picture.rows; ++y) {
    for (int x = 0; x < picture.cols; ++x) {
      const std::uint32_t surface = view.surfaces[static_cast<std::size_t>(y) * picture.cols + x];
      if (surface == kNoSurface) continue;
      const std::uint32_t id = surface == kTerrainSurface ? 0xFFFFFFu : surface + 1;
      picture.at<cv::Vec3b>(y, x) = cv::Vec3b(static_cast<uchar>(id & 255),
                                              static_cast<uchar>((id >> 8) & 255),
                                              static_cast<uchar>((id >> 16) & 255));
    }
  }
  return picture;
}

cv::Mat ShadedPicture(const ViewBuffers& view, const CityModel& model) {
  const cv::Vec3f light = cv::normalize(cv::Vec3f(-0.45f, -0.6f, 0.66f));
  cv::Mat picture(view.depth.size(), CV_8UC3, cv::Scalar(235, 215, 190));
  for (int y = 0; y < picture.rows; ++y) {
    for (int x = 0; x < picture.cols; ++x) {
      const std::uint32_t surface = view.surfaces[static_cast<std::size_t>(y) * picture.cols + x];
      if (surface == kNoSurface) continue;
      const float shade =
          0.62f + 0.38f * std::max(-0.5f, view.normals.at<cv::Vec3f>(y, x).dot(light));
      picture.at<cv::Vec3b>(y, x) = shade * ColorOf(surface, model);
    }
  }
  return picture;
}

}  // namespace ridgeline
