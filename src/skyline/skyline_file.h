// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "camera/intrinsics.h"
#include "skyline/skyline.h"

namespace ridgeline {

// A skyline found by another program, such as a network for sky segmentation (the outlook of Ayadi et
// al.), for a picture of `camera`. Either of
//   - a mask (PNG or the like, 8 bit): the sky is bright, 128 and more; grey values are taken as the
//     network's probability, whose distance from 1/2 along the boundary is the confidence. As large as
//     the picture or of its shape; undistorted here. The sky of a column is what is bright from the
//     top on without a break of more than 2 % of the height (wires, birds).
//   - a CSV with the columns x_px, y_px and perhaps state (seen, above, below, unknown) and confidence,
//     one row per column of the undistorted picture at equal steps, as `skyline --columns` writes.
// Throws InputError with file and line for anything else.
Skyline ReadSkylineFile(const std::filesystem::path& path, const CameraIntrinsics& camera);

// The file of a frame in a folder: ID.png, ID.jpg, ID.csv or ID_skyline.csv; nullopt: none.
std::optional<std::filesystem::path> SkylineFileOf(const std::filesystem::path& folder,
                                                   const std::string& id);

}  // namespace ridgeline
