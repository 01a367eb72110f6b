// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "convert/convert_options.h"
#include "input/dataset.h"

namespace ridgeline {

// A folder of LoD-Loc (Zhu et al. 2024), such as UAVD4L-LoD/inTraj or Swiss-EPFL/inPlace:
// intrinsic.txt (name MODEL width height params), GT_pose.txt and GPS_pose.txt (name qw qx qy qz tx
// ty tz, cam_from_world) and the pictures in Query_image. GT poses become truths, GPS poses priors;
// either may be missing. Throws InputError with file and line.
// Source: github.com/VictorZoo/LoD-Loc, README.md and script/utils.py.
Dataset ReadLodLoc(const std::filesystem::path& folder, const ConvertOptions& options);

}  // namespace ridgeline
