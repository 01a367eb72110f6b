// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <vector>

#include "projection/scene.h"
#include "skyline/canny_skyline.h"

namespace ridgeline {

// The model's skyline from a position as Ayadi et al. find it: extracted from rendered images by the
// same algorithm as the picture's (section 3, step 4). Level views of 60 degrees each cover the
// sector. Scene::SkylineFrom() is exact and needs no image; this is off by what pixels, Canny and the
// path make of it.
//
// @param px_per_rad  Resolution of the images; that of the camera.
// Unit vectors to the points of the skyline, by azimuth.
std::vector<Eigen::Vector3f> RenderedSkyline(const Scene& scene,
                                             const Eigen::Vector3d& position,
                                             const Sector& sector,
                                             double px_per_rad,
                                             const CannySkylineOptions& options);

}  // namespace ridgeline
