// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <opencv2/core/mat.hpp>
#include <string>
#include <vector>

#include "camera/focal_length.h"
#include "camera/intrinsics.h"
#include "camera/picture_facts.h"

namespace ridgeline {

// A camera made from what a picture says.
struct PictureCamera {
  CameraIntrinsics camera;
  std::string source;    // where the focal length comes from, in words
  bool assumed = false;  // the picture does not tell it
  // What else the picture's words may mean, the camera's own focal length first; focal lengths are
  // those of `camera`, which takes another as params[0].
  std::vector<FocalHypothesis> focal_lengths;
  std::vector<std::string> notes;  // how the focal lengths were compared
};

// The camera of a picture as it is shown, upright, with square pixels, the principal point in the
// middle and no distortion; its focal length is the most plausible of FocalLengthOf.
//
// @param width, height  Of the stored picture [px], before EXIF orientation.
PictureCamera CameraOf(const PictureFacts& facts, int width, int height);

// The picture as its EXIF orientation says that it is to be shown.
cv::Mat TurnedUpright(const cv::Mat& stored, int orientation);

}  // namespace ridgeline
