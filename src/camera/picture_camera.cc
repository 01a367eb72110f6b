// SPDX-License-Identifier: Apache-2.0
#include "camera/picture_camera.h"

#include <opencv2/core.hpp>
#include <utility>

namespace ridgeline {

PictureCamera CameraOf(const PictureFacts& facts, int width, int height) {
  FocalLength focal = FocalLengthOf(facts, width, height);
  PictureCamera result;
  const bool swapped = OrientationSwapsSides(facts.orientation);
  result.camera.model = "SIMPLE_PINHOLE";
  result.camera.width = swapped ? height : width;
  result.camera.height = swapped ? width : height;
  result.camera.params = {
      focal.hypotheses.front().focal_px, 0.5 * result.camera.width, 0.5 * result.camera.height};
  result.source = focal.hypotheses.front().reason;
  result.assumed = focal.assumed;
  result.focal_lengths = std::move(focal.hypotheses);
  result.notes = std::move(focal.notes);
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
