// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "camera/intrinsics.h"
#include "lines/line_segment.h"

namespace ridgeline {

struct LineFamilyOptions {
  // Largest angle between a line and the direction of its family's vanishing point [deg].
  double max_angle_deg = 2.0;
  // Horizontal families: least share of the length of all lines, and least angle between two [deg].
  double min_share = 0.05;
  double separation_deg = 8.0;
};

// Which lines of a picture are images of parallel lines.
struct LineFamilies {
  static constexpr int kNone = -1;
  static constexpr int kVertical = 0;
  // Directions in camera axes, unit: the vertical (up), then horizontal ones, the longest first.
  std::vector<Eigen::Vector3d> directions;
  std::vector<int> family_of_line;  // index into directions, or kNone
};

// Labels lines by vanishing points: the vertical one, which follows from the camera's tilt, and
// horizontal ones, the peaks of the lines' headings weighted by length: the plane through a line and
// the projection centre meets the horizontal plane in one direction. Lines along the horizon have no
// heading and stay without family.
// @param up_in_camera  Unit vector against gravity in camera axes.
LineFamilies FindLineFamilies(std::span<const LineSegment> segments,
                              const PinholeCamera& camera,
                              const Eigen::Vector3d& up_in_camera,
                              const LineFamilyOptions& options);

// Signed angle [rad], in [-pi / 2, pi / 2], at the middle of a line from the image of lines of a
// direction (camera axes) to it; the line has no direction of its own. 0 if the middle is the
// vanishing point itself.
double AngleToDirection(const LineSegment& segment,
                        const PinholeCamera& camera,
                        const Eigen::Vector3d& direction_in_camera);

}  // namespace ridgeline
