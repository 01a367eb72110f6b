// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <opencv2/core/mat.hpp>
#include <optional>
#include <string>
#include <vector>

#include "camera/intrinsics.h"
#include "track/motion.h"

namespace ridgeline {

// How a camera has moved, from its pictures alone: corners followed by optical flow (Lucas-Kanade in
// pyramids) and the essential matrix of five points under RANSAC, all of OpenCV. Approximate: the
// length of a step is not seen, and its direction is good to some degrees.
class VisualMotion {
 public:
  struct Result {
    std::optional<Motion> motion;  // its step has length 1, or 0 where the camera stands
    bool is_standing = false;
    // The picture has nothing in common with the one before.
    bool is_cut = false;
    // Factor by which the picture has grown about its middle, where a turn and a growth explain the
    // flow better than a way: the focal length has changed by it.
    std::optional<double> zoom;
    int followed = 0;     // corners
    std::string missing;  // why there is no motion, in words
  };

  // @param bgr  CV_8UC3 without distortion; the first picture has no motion.
  Result Next(const cv::Mat& bgr, const PinholeCamera& camera);

 private:
  cv::Mat before_;  // grey, reduced
  PinholeCamera camera_;
};

}  // namespace ridgeline
