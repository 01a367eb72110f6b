// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "camera/intrinsics.h"
#include "camera/pose.h"
#include "lines/line_segment.h"

namespace ridgeline {

// A hypothesis of the camera's tilt.
struct Tilt {
  double pitch_deg = 0.0;
  double roll_deg = 0.0;
  double log_ratio = 0.0;  // of the picture's lines against lines without a vertical family
};

// Tilts within the half-ranges around `center` under which most of the picture's lines are images of
// vertical lines (corners, windows, door posts): best first, at least `separation_deg` apart, at most
// `count`. A parameter with a half-range of 0 stays as it is. Without free parameters, or without
// lines, the centre is the only answer.
// Vertical vanishing point as a likelihood over its two angles; cf. Lobo and Dias, "Vision and
// inertial sensor cooperation using gravity as a vertical reference", PAMI 2003.
std::vector<Tilt> FindTilts(std::span<const LineSegment> segments,
                            const PinholeCamera& camera,
                            const ViewAngles& center,
                            double pitch_half_range_deg,
                            double roll_half_range_deg,
                            double separation_deg,
                            int count);

}  // namespace ridgeline
