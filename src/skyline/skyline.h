// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace ridgeline {

// What is known of the skyline in one column of the picture.
enum class SkylineColumn : std::uint8_t {
  kSeen,        // sky above y_px, something else below
  kAboveImage,  // no sky in the column: the skyline is above the picture (y_px = 0)
  kBelowImage,  // sky all the way down: the skyline is below the picture (y_px = height)
  kUnknown,     // trees, holes, or no evidence: y_px is a guess that must not be relied on
};

// A skyline as a function of the image column. Pixels of the input picture, with the origin at the
// upper left corner of the upper left pixel (COLMAP).
struct Skyline {
  int image_width = 0;
  int image_height = 0;
  double column_step_px = 1.0;         // column i is at x = (i + 0.5) * column_step_px
  std::vector<float> y_px;             // boundary between sky and the rest, in [0, height]
  std::vector<float> confidence;       // of y_px, in [0, 1]; 0 for kUnknown
  std::vector<SkylineColumn> columns;  // as many as y_px

  std::size_t size() const { return y_px.size(); }
  double XOf(std::size_t column) const {
    return (static_cast<double>(column) + 0.5) * column_step_px;
  }
};

}  // namespace ridgeline
