// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <optional>

namespace ridgeline {

// Height of a camera in the hand above the ground that its owner stands on [m], where no option
// says another (search.camera_height_m does).
inline constexpr double kCameraHeightM = 1.7;

// What is known of a pose before looking at the picture. Parts that are not known are absent.
struct PosePrior {
  Eigen::Vector2d position_in_world = Eigen::Vector2d::Zero();  // easting, northing [m]
  std::optional<double> height_in_world;                        // [m]; absent: DTM + camera height
  std::optional<double> heading_deg;                            // absent: any
  std::optional<double> pitch_deg;                              // absent: level
  std::optional<double> roll_deg;                               // absent: level
};

}  // namespace ridgeline
