// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <opencv2/core/mat.hpp>

#include "camera/intrinsics.h"
#include "camera/pose.h"
#include "synth/town.h"
#include "synth/weather.h"

namespace ridgeline {

// What a view would show, from a coarse grid of rays.
struct ViewStatistics {
  double building_share = 0.0;
  double sky_share = 0.0;
  double nearest_m = 0.0;          // along the rays
  double median_building_m = 0.0;  // 0 without buildings
  int buildings = 0;               // that fill at least 1 % of the view
  double skyline_share = 0.0;      // columns with sky above a building
};

// Ray tracer for photos of the town: sun with shadows, sky light with ambient occlusion, haze.
// Thread-safe after construction.
class TownRenderer {
 public:
  // The town must outlive the renderer. `overhang_m`: mean overhang of the eaves.
  TownRenderer(const Town& town, double overhang_m);
  ~TownRenderer();

  // Linear RGB radiance (CV_32FC3), four rays per pixel. Same result on any number of threads.
  cv::Mat Render(const CameraIntrinsics& camera,
                 const Pose& cam_from_local,
                 const Weather& weather,
                 int threads) const;

  ViewStatistics Probe(const CameraIntrinsics& camera, const Pose& cam_from_local) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

// The radiance as a camera would store it (8-bit BGR): exposure, white balance, lens blur, sensor
// noise, gamma. `key` addresses the random numbers.
cv::Mat DevelopPhoto(const cv::Mat& radiance, std::uint64_t key);

}  // namespace ridgeline
