// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <vector>

namespace ridgeline {

// The surface index of the terrain.
inline constexpr std::uint32_t kTerrainSurface = 0xFFFFFFFEu;

// Depth [m along the optical axis] and surface index per pixel; infinity / kNoSurface: sky.
struct ViewBuffers {
  cv::Mat depth;                        // CV_32F
  std::vector<std::uint32_t> surfaces;  // row-major
  cv::Mat normals;  // CV_32FC3, unit, local frame, towards the camera; zero: sky. Empty: not asked.
};

}  // namespace ridgeline
