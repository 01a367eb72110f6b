// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "convert/convert_options.h"
#include "convert/text_lines.h"
#include "input/dataset.h"

namespace ridgeline {

// The lists of visuallocalization.net, as its benchmarks (Aachen, RobotCar, ...) and hloc have
// them.
//   Queries with intrinsics: name MODEL width height params...   (COLMAP's models)
//   Poses:                   name qw qx qy qz tx ty tz           (cam_from_world, as in COLMAP)
// The first line of data tells which it is. Poses become truths. Throws InputError with file and
// line.
Dataset ReadVisualLocalizationList(const std::filesystem::path& file,
                                   const ConvertOptions& options);

// The poses of a list by picture name.
std::vector<std::pair<std::string, Pose>> ReadPoseList(const std::filesystem::path& file,
                                                       const ConvertOptions& options);

// The cameras of a list by picture name.
std::vector<std::pair<std::string, CameraIntrinsics>> ReadCameraList(
    const std::filesystem::path& file);

}  // namespace ridgeline
