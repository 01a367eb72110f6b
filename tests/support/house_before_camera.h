// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <opencv2/core.hpp>

#include "camera/intrinsics.h"
#include "projection/scene.h"
#include "projection/view_buffers.h"
#include "support/synthetic_city.h"

namespace ridgeline::testing {

inline const PinholeCamera kCamera{320, 240, 260.0, 260.0, 160.0, 120.0};

// One house before the camera, which looks north, and a photo of it.
class HouseBeforeCamera {
 public:
  HouseBeforeCamera() : model_(OneHouse()), scene_(model_, nullptr, {}) {}

  // The house in grey before a light sky and dark ground.
  cv::Mat Photo() const {
    const ViewBuffers buffers = scene_.Render(kCamera, North());
    cv::Mat picture(kCamera.height, kCamera.width, CV_8UC3, cv::Scalar(240, 220, 200));
    picture.rowRange(kCamera.height / 2, kCamera.height).setTo(cv::Scalar(60, 70, 60));
    for (int y = 0; y < picture.rows; ++y) {
      for (int x = 0; x < picture.cols; ++x) {
        const std::uint32_t surface =
            buffers.surfaces[static_cast<std::size_t>(y) * picture.cols + x];
        if (surface == kNoSurface) continue;
        const auto shade =
            static_cast<unsigned char>(120.0f + 60.0f * model_.surfaces[surface].normal.x());
        picture.at<cv::Vec3b>(y, x) = {shade, shade, shade};
      }
    }
    return picture;
  }

  static Pose North(double heading_deg = 0.0) {
    return {CamFromWorld(ViewAngles{heading_deg, 5.0, 0.0}), {0.0, 0.0, 1.7}};
  }

 private:
  static CityModel OneHouse() {
    House house;
    house.center = {0.0, 20.0};
    house.ridge_m = 9.0;
    house.heading_deg = 30.0;
    return MakeCity({house});
  }

 protected:
  CityModel model_;
  Scene scene_;
};

}  // namespace ridgeline::testing
