// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstdint>
#include <opencv2/imgproc.hpp>

#include "base/random.h"

namespace ridgeline::testing {

inline const cv::Scalar kOvercast(238, 232, 230), kWhite(255, 252, 255), kBlue(205, 150, 95);

// Sky above a row of facades with windows; the skyline is at 200, 120 and 160 in the thirds of a
// 640 x 480 picture. Noise of a few grey values everywhere.
inline cv::Mat StreetPicture(const cv::Scalar& sky, std::uint64_t seed = 1) {
  cv::Mat picture(480, 640, CV_8UC3, sky);
  const cv::Scalar walls[] = {{120, 150, 170}, {205, 210, 215}, {90, 110, 150}};
  const int tops[] = {200, 120, 160};
  for (int i = 0; i < 3; ++i) {
    const int left = i * 640 / 3, right = (i + 1) * 640 / 3;
    cv::rectangle(picture, {left, tops[i]}, {right - 1, 479}, walls[i], cv::FILLED);
    for (int y = tops[i] + 20; y < 400; y += 50) {
      for (int x = left + 20; x + 20 < right; x += 45) {
        cv::rectangle(picture, {x, y}, {x + 18, y + 28}, {50, 50, 45}, cv::FILLED);
      }
    }
  }
  cv::rectangle(picture, {0, 420}, {639, 479}, {95, 95, 95}, cv::FILLED);
  Random random(seed, 0);
  for (int y = 0; y < picture.rows; ++y) {
    for (int x = 0; x < picture.cols * 3; ++x) {
      std::uint8_t& p = picture.ptr(y)[x];
      p = cv::saturate_cast<std::uint8_t>(p + 2.0 * random.Normal());
    }
  }
  return picture;
}

inline double StreetSkyline(double x) {
  return x < 640.0 / 3 ? 200.0 : x < 1280.0 / 3 ? 120.0 : 160.0;
}

}  // namespace ridgeline::testing
