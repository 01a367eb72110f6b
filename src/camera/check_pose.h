// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <span>
#include <string>

namespace ridgeline {

// Poses as they enter from outside.

// Throws InputError(file, field) for a position that is on no projected plane: a coordinate that is
// not finite or beyond limits::kCoordinate, a height beyond limits::kHeight.
void CheckPlace(const Eigen::Vector3d& center_in_world,
                const std::string& file,
                const std::string& field);

// The rotation of w, x, y, z. Throws InputError(file, field) unless its norm is 1 within 0.001, as
// of numbers with few digits; a unit quaternion stays as it is written.
Eigen::Quaterniond UnitQuaternion(std::span<const double> wxyz,
                                  const std::string& file,
                                  const std::string& field);

}  // namespace ridgeline
