// SPDX-License-Identifier: Apache-2.0
#include "track/rendered_skyline.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "score/skyline_l1.h"
#include "support/synthetic_city.h"

namespace ridgeline {
namespace {

// Elevation at an azimuth by the nearest direction.
double ElevationAt(const std::vector<Eigen::Vector3f>& directions, double azimuth) {
  double nearest = 1e9, elevation = NAN;
  for (const Eigen::Vector3f& d : directions) {
    const double off =
        std::abs(std::remainder(std::atan2(d.x(), d.y()) - azimuth, 2.0 * std::numbers::pi));
    if (off >= nearest) continue;
    nearest = off;
    elevation = std::asin(std::clamp(d.z(), -1.0f, 1.0f));
  }
  return elevation;
}

// What Canny finds in the rendered images is the exact skyline to a pixel or two, except at vertical
// steps, where the nearest column may lie on the other side.
TEST(RenderedSkyline, IsTheExactOneToAPixelOrTwo) {
  const CityModel model = testing::MakeCity({{{-8.0, 30.0}, 10.0, 9.0, 10.0, 0.0, 7.0, 10.0},
                                             {{9.0, 26.0}, 9.0, 8.0, 0.0, 0.0, 6.0, 6.0}});
  const Scene scene(model, nullptr, ProjectionOptions{});
  const Eigen::Vector3d eye(0.0, 0.0, 1.6);
  const Sector sector{0.0, 0.9};
  constexpr double kPxPerRad = 500.0;
  const auto rendered = RenderedSkyline(scene, eye, sector, kPxPerRad, CannySkylineOptions{});
  const auto exact = SkylineDirections(scene.SkylineFrom(eye, sector));
  ASSERT_GT(rendered.size(), 500u);
  int near = 0, all = 0;
  for (double azimuth = -0.8; azimuth <= 0.8; azimuth += 0.005) {
    ++all;
    near += std::abs(ElevationAt(rendered, azimuth) - ElevationAt(exact, azimuth)) < 2.0 / kPxPerRad;
  }
  EXPECT_GT(near, 0.93 * all);
}

}  // namespace
}  // namespace ridgeline
