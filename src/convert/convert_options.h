// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "camera/intrinsics.h"

namespace ridgeline {

// What a file of another program leaves open.
struct ConvertOptions {
  // Projected system of the poses; formats with latitudes need it.
  std::string crs;
  // Added to the positions read, subtracted from those written [m]: east, north, height. Absent:
  // what the file's own "# origin" says, else nothing.
  std::optional<Eigen::Vector3d> origin;
  // Camera of the pictures whose format has none.
  std::optional<CameraIntrinsics> camera;
};

}  // namespace ridgeline
