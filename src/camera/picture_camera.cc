// SPDX-License-Identifier: Apache-2.0
#include "camera/picture_camera.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <opencv2/core.hpp>

namespace ridgeline {
namespace {

// The main cameras of phones since 2015 have 24 to 28 mm.
constexpr double kAssumed35mm = 26.0;

std::string Text(const char* format, double a, double b = 0.0) {
  char text[160];
  std::snprintf(text, sizeof(text), format, a, b);
  return text;
}

// Focal length [px of the longer side's pixels], and where it comes from.
struct Focal {
  double px = 0.0;
  std::string source;
  bool assumed = false;
};

Focal FocalOf(const PictureFacts& facts, double width, double height) {
  const double long_side = std::max(width, height);
  const double diagonals = std::hypot(width, height) / std::hypot(36.0, 24.0);
  if (facts.focal_px) {
    return {*facts.focal_px, Text("%.1f px, calibrated by the maker", *facts.focal_px)};
  }
  if (facts.focal_35mm) {
    return {*facts.focal_35mm * diagonals, Text("35 mm equivalent %.4g mm", *facts.focal_35mm)};
  }
  if (facts.focal_mm && facts.plane_px_per_mm && facts.plane_width_px) {
    // The plane's resolution belongs to a picture that may have been resized since.
    const double resized = width / *facts.plane_width_px;
    return {*facts.focal_mm * *facts.plane_px_per_mm * resized,
            Text("focal length %.4g mm at %.4g px/mm of the sensor's plane",
                 *facts.focal_mm,
                 *facts.plane_px_per_mm)};
  }
  if (facts.focal_mm) {
    if (const auto sensor = SensorWidthMm(facts.camera)) {
      return {*facts.focal_mm / *sensor * long_side * facts.zoom.value_or(1.0),
              Text("focal length %.4g mm, sensor %.4g mm wide", *facts.focal_mm, *sensor) + " (" +
                  facts.camera + ")"};
    }
  }
  return {kAssumed35mm * diagonals,
          Text("not told by the picture; %.0f mm equivalent assumed, as of a phone", kAssumed35mm),
          true};
}

}  // namespace

PictureCamera CameraOf(const PictureFacts& facts, int width, int height) {
  const Focal focal = FocalOf(facts, width, height);
  PictureCamera result;
  const bool swapped = OrientationSwapsSides(facts.orientation);
  result.camera.model = "SIMPLE_PINHOLE";
  result.camera.width = swapped ? height : width;
  result.camera.height = swapped ? width : height;
  result.camera.params = {focal.px, 0.5 * result.camera.width, 0.5 * result.camera.height};
  result.source = focal.source;
  result.assumed = focal.assumed;
  return result;
}

cv::Mat TurnedUpright(const cv::Mat& stored, int orientation) {
  if (orientation == 1) return stored;
  cv::Mat shown;
  cv::Mat transposed;
  if (orientation >= 5) cv::transpose(stored, transposed);
  switch (orientation) {
    case 2:
      cv::flip(stored, shown, 1);
      return shown;
    case 3:
      cv::rotate(stored, shown, cv::ROTATE_180);
      return shown;
    case 4:
      cv::flip(stored, shown, 0);
      return shown;
    case 6:
      cv::flip(transposed, shown, 1);
      return shown;
    case 7:
      cv::rotate(transposed, shown, cv::ROTATE_180);
      return shown;
    case 8:
      cv::flip(transposed, shown, 0);
      return shown;
    default:
      return transposed;
  }
}

}  // namespace ridgeline
