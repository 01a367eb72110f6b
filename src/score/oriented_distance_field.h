// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <vector>

#include "lines/line_segment.h"

namespace ridgeline {

// For every pixel and every undirected direction the distance to the nearest segment of about that
// direction, and how dense such segments are around it. Directional chamfer matching: Liu et al.,
// "Fast directional chamfer matching", CVPR 2010.
class OrientedDistanceField {
 public:
  static constexpr int kDirections = 18;        // of 10 degrees
  static constexpr float kUnitsPerPx = 8.0f;    // distances are stored in 1/8 px, up to 31.9 px
  static constexpr int kDensityLevels = 16;     // see DensityOfLevel
  static constexpr int kHiddenLevel = kDensityLevels;
  static constexpr int kDensityCellPx = 8;

  // Segments [px of an image width x height]. The directions are computed in parallel.
  // @param hidden  CV_8U, of the image; not 0 where something hides what could be seen, whose lines
  //                say nothing. Empty: nowhere.
  OrientedDistanceField(const std::vector<LineSegment>& segments,
                        int width,
                        int height,
                        int threads,
                        const cv::Mat& hidden = {});

  int width() const { return width_; }
  int height() const { return height_; }

  // Direction bin of a vector of the image plane; opposite vectors share it.
  static int DirectionOf(float dx, float dy);
  // Segment length per area [1 / px] that a density level stands for (levels are geometric).
  static float DensityOfLevel(int level);

  // Distance [1/8 px] at a pixel inside the image.
  std::uint8_t Distance(int direction, int x, int y) const {
    return distances_[(static_cast<std::size_t>(direction) * height_ + y) * width_ + x];
  }
  // Below kDensityLevels, or kHiddenLevel.
  std::uint8_t DensityLevel(int direction, int x, int y) const {
    return densities_[(static_cast<std::size_t>(direction) * cell_rows_ + y / kDensityCellPx) *
                          cell_columns_ +
                      x / kDensityCellPx];
  }

 private:
  int width_ = 0;
  int height_ = 0;
  int cell_columns_ = 0;
  int cell_rows_ = 0;
  std::vector<std::uint8_t> distances_;
  std::vector<std::uint8_t> densities_;
};

}  // namespace ridgeline
