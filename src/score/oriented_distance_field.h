// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <vector>

#include "lines/line_segment.h"
#include "projection/simd4.h"

namespace ridgeline {

// For every pixel and every undirected direction the distance to the nearest segment of about that
// direction, and how dense such segments are around it. Distances are kept for every second pixel
// of every second row: a fraction of the error of any line, and a quarter of the memory, which is
// what a sample costs. Directional chamfer matching: Liu et al., "Fast directional chamfer
// matching", CVPR 2010.
class OrientedDistanceField {
 public:
  static constexpr int kDirections = 18;      // of 10 degrees
  static constexpr float kUnitsPerPx = 8.0f;  // distances are stored in 1/8 px, up to 31.9 px
  static constexpr int kDensityLevels = 16;   // see DensityOfLevel
  static constexpr int kHiddenLevel = kDensityLevels;
  static constexpr int kDensityCellPx = 8;
  static constexpr int kDistanceCellPx = 2;

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
  // Of four vectors, by an approximation that is 3e-7 rad off.
  static simd::Int4 DirectionsOf(simd::Float4 dx, simd::Float4 dy);
  // Segment length per area [1 / px] that a density level stands for (levels are geometric).
  static float DensityOfLevel(int level);

  // What the field holds of one direction.
  struct Plane {
    const std::uint8_t* distances;
    const std::uint8_t* densities;
    unsigned distance_columns;
    unsigned cell_columns;

    // As those of the field.
    std::uint8_t Distance(unsigned x, unsigned y) const {
      return distances[y / kDistanceCellPx * distance_columns + x / kDistanceCellPx];
    }
    std::uint8_t DensityLevel(unsigned x, unsigned y) const {
      return densities[y / kDensityCellPx * cell_columns + x / kDensityCellPx];
    }
  };
  Plane PlaneOf(int direction) const {
    return {&distances_[static_cast<std::size_t>(direction) * distance_rows_ * distance_columns_],
            &densities_[static_cast<std::size_t>(direction) * cell_rows_ * cell_columns_],
            static_cast<unsigned>(distance_columns_),
            static_cast<unsigned>(cell_columns_)};
  }

  // Distance [1/8 px] at a pixel inside the image.
  std::uint8_t Distance(int direction, int x, int y) const {
    return PlaneOf(direction).Distance(static_cast<unsigned>(x), static_cast<unsigned>(y));
  }
  // Below kDensityLevels, or kHiddenLevel.
  std::uint8_t DensityLevel(int direction, int x, int y) const {
    return PlaneOf(direction).DensityLevel(static_cast<unsigned>(x), static_cast<unsigned>(y));
  }

 private:
  int width_ = 0;
  int height_ = 0;
  int distance_columns_ = 0;
  int distance_rows_ = 0;
  int cell_columns_ = 0;
  int cell_rows_ = 0;
  std::vector<std::uint8_t> distances_;
  std::vector<std::uint8_t> densities_;
};

}  // namespace ridgeline
