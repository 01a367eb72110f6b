// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <string>

namespace ridgeline {

// "654021..654296 E, 5411980..5412250 N", for messages.
std::string BoxText(const Eigen::AlignedBox2d& box);

}  // namespace ridgeline
