// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <opencv2/core/mat.hpp>

#include "camera/intrinsics.h"
#include "camera/pose.h"
#include "city/city_model.h"
#include "projection/scene.h"

namespace ridgeline {

struct InsertOptions {
  // From where the light falls: azimuth clockwise from north, elevation [deg].
  double light_azimuth_deg = 220.0;
  double light_elevation_deg = 40.0;
  // Opacity of the inserted building, (0, 1].
  double opacity = 1.0;
};

// What an insertion did to a picture.
struct InsertedPicture {
  cv::Mat picture;             // 8-bit BGR
  double visible_share = 0.0;  // of the picture
  double hidden_share = 0.0;   // of the building's own outline, behind the city or the terrain
};

// Draws a building into a photo (8-bit BGR) at the photo's pose, hidden where the city or its
// terrain is in front of it (Ayadi et al., section 7.1). Edges are smoothed by four rays per pixel.
//
// @param city  The surroundings, with terrain.
// @param building  Scene of what is inserted, in the same local frame.
InsertedPicture InsertBuilding(const cv::Mat& photo,
                               const Scene& city,
                               const Scene& building,
                               const PinholeCamera& camera,
                               const Pose& cam_from_local,
                               const InsertOptions& options);

// The model turned and moved so that the middle of its base comes to `base` (local frame of the
// target), turned clockwise by the heading and scaled.
CityModel PlacedModel(const CityModel& model,
                      const Eigen::Vector3d& base,
                      double heading_deg,
                      double scale);

}  // namespace ridgeline
