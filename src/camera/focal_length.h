// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "camera/picture_facts.h"

namespace ridgeline {

// One reading of what a picture says about its focal length.
struct FocalHypothesis {
  double focal_px = 0.0;  // square pixels, at the size of the picture at hand
  double sigma_percent =
      0.0;             // one standard deviation of the focal length, if the reading is right
  std::string reason;  // what was read and how, in words
};

struct FocalLength {
  // At least one, the most plausible first; they differ by more than their doubts. One is right
  // with good probability; where the first is wrong (a digital zoom that a maker counts or does not
  // count, a picture cut to another shape), one of the others mostly is right: try them in order.
  std::vector<FocalHypothesis> hypotheses;
  bool assumed = false;            // the picture does not tell it; hypotheses are guesses
  std::vector<std::string> notes;  // how the readings were compared, a sentence each
};

// The focal lengths [px] that a picture's words may mean, each brought to the size of the picture
// at hand: the maker's calibration (px or mm, at the size it belongs to); the 35 mm equivalent (by
// diagonals, as CIPA DCG-001 defines it); the focal length with the width of the model's sensor, or
// with the resolution of the sensor's plane. They are weighed by how far their source is trusted
// (in this order) and by which others agree within 15 %; what gives a field of view (across the
// diagonal) outside of 5 to 150 degrees is dropped. Without any: a phone's main camera.
//
// Digital zoom: Apple's equivalents contain it; Google's and Samsung's do not (exiftool's pictures;
// photos of an SM-S906U1 against their calibrations: 23 mm throughout, by the diagonal within
// 1.3 % at ratios 1.00 to 1.44, 4 % at 2.41). For other makers both are hypotheses, unless the
// model's sensor tells.
//
// @param width, height  Of the stored picture [px].
FocalLength FocalLengthOf(const PictureFacts& facts, int width, int height);

// Whether a camera of this focal length and size [px] sees 5 to 150 degrees across its diagonal.
bool IsPlausibleFocal(double focal_px, double width, double height);

// Field of view across the diagonal [deg].
double DiagonalViewDeg(double focal_px, double width, double height);

}  // namespace ridgeline
