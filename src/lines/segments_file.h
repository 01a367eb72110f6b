// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <vector>

#include "camera/intrinsics.h"
#include "lines/line_segment.h"

namespace ridgeline {

// Segments of any detector: one "x0 y0 x1 y1 [score]" a line, pixels of the original picture; "#"
// starts a comment. Undistorted with `camera`. Throws InputError with the line number.
std::vector<LineSegment> ReadSegments(const std::filesystem::path& path,
                                      const CameraIntrinsics& camera);

}  // namespace ridgeline
