// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <opencv2/core/mat.hpp>
#include <optional>
#include <string>
#include <vector>

#include "camera/intrinsics.h"

namespace ridgeline {

// A flat checkerboard, by its inner corners.
struct CheckerboardOptions {
  int columns = 9;  // inner corners across and down, both at least 3, not equal to each other
  int rows = 6;
  // Frames used at most: the ones whose boards differ most.
  int max_views = 40;
  // Lens model: "opencv" (k1, k2, p1, p2), "radial" (k1, k2, one focal length) or "pinhole".
  std::string model = "opencv";

  // Throws InputError naming the argument.
  void Validate() const;
};

// The board as one frame shows it.
struct BoardView {
  std::string frame;
  std::vector<cv::Point2f> corners;  // row by row [px, OpenCV's pixel centres]
};

// Corners of the board in a picture (8 bit), to a fraction of a pixel; nullopt: not seen whole.
std::optional<BoardView> FindBoard(const cv::Mat& picture,
                                   const std::string& frame,
                                   const CheckerboardOptions& options);

struct Calibration {
  CameraIntrinsics camera;
  double rms_px = 0.0;  // of the reprojection
  std::vector<std::string> frames;
  std::vector<double> frame_rms_px;
  // Standard deviations of fx, fy, cx, cy [px].
  double sigma_px[4] = {0.0, 0.0, 0.0, 0.0};
  // Share of the picture (cells of a 6 x 6 grid) that the corners cover.
  double covered = 0.0;
};

// The camera (Zhang's method, OpenCV; as Ayadi et al., section 5.2) from the views of one size of
// picture. Chooses the views. Throws InputError for fewer than five views.
Calibration CalibrateCamera(const std::vector<BoardView>& views,
                            int width,
                            int height,
                            const CheckerboardOptions& options);

}  // namespace ridgeline
