// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <opencv2/core/mat.hpp>
#include <optional>
#include <string>
#include <string_view>

#include "camera/intrinsics.h"
#include "camera/picture_facts.h"

namespace ridgeline {

// A camera made from what a picture says.
struct PictureCamera {
  CameraIntrinsics camera;
  std::string source;    // where the focal length comes from, in words
  bool assumed = false;  // the picture does not tell it
};

// The camera of a picture as it is shown, upright, with square pixels, the principal point in the
// middle and no distortion. The focal length: calibrated by the maker; else the 35 mm equivalent
// (by diagonals, as CIPA DCG-001 defines it); else the focal length with the resolution of the
// sensor's plane, or with the width of the sensor; else that of a phone's main camera.
//
// @param width, height  Of the stored picture [px], before EXIF orientation.
PictureCamera CameraOf(const PictureFacts& facts, int width, int height);

// The picture as its EXIF orientation says that it is to be shown.
cv::Mat TurnedUpright(const cv::Mat& stored, int orientation);

// Width of a camera's sensor [mm], longer side, by the model name in its EXIF; nullopt: unknown.
// For cameras that do not tell their 35 mm equivalent.
std::optional<double> SensorWidthMm(std::string_view model);

}  // namespace ridgeline
