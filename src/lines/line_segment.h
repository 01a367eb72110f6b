// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

namespace ridgeline {

// A straight edge in a picture. Image coordinates as in COLMAP: the centre of the first pixel is
// (0.5, 0.5). Directed so that the brighter side lies to the right of a -> b (in the image, y down)
// where the detector knows the sign of the gradient.
struct LineSegment {
  Eigen::Vector2f a = Eigen::Vector2f::Zero();  // [px]
  Eigen::Vector2f b = Eigen::Vector2f::Zero();  // [px]
  float strength = 1.0f;  // mean gradient magnitude across it [grey values / px], > 0

  float Length() const { return (b - a).norm(); }
};

}  // namespace ridgeline
