// SPDX-License-Identifier: Apache-2.0
// Poses and cameras as they enter from outside.
#include "camera/check_pose.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <string>

#include "base/error.h"
#include "camera/intrinsics.h"

namespace ridgeline {
namespace {

using ::testing::HasSubstr;

template <typename Action>
std::string Message(Action action) {
  try {
    action();
  } catch (const InputError& e) {
    return e.what();
  }
  return "";
}

std::string MessageOfPlace(double east, double north, double height) {
  return Message([&] { CheckPlace({east, north, height}, "a.json", "position"); });
}

TEST(CheckPlace, PlacesOnNoPlaneAreRefused) {
  EXPECT_EQ(MessageOfPlace(654000.0, 5412000.0, 400.0), "");
  EXPECT_EQ(MessageOfPlace(-1e8, 1e8, -1e5), "");
  EXPECT_EQ(MessageOfPlace(1e300, 5412000.0, 400.0),
            "a.json: position: got 1e+300, expected east and north in metres, below 1e8");
  EXPECT_EQ(MessageOfPlace(654000.0, 5412000.0, 1e300),
            "a.json: position: got the height 1e+300, expected a height in metres, below 1e5");
  EXPECT_THAT(MessageOfPlace(std::nan(""), 0.0, 0.0), HasSubstr("got nan"));
  EXPECT_THAT(MessageOfPlace(0.0, 0.0, std::numeric_limits<double>::infinity()), HasSubstr("inf"));
}

TEST(UnitQuaternion, OnlyRotationsPass) {
  const auto message = [](std::array<double, 4> q) {
    return Message([&] { UnitQuaternion(q, "a.json", "q"); });
  };
  EXPECT_EQ(message({0.5, -0.5, 0.5, -0.5}), "");
  EXPECT_EQ(message({0.0, 0.0, 0.0, 0.0}),
            "a.json: q: got norm 0, expected a unit quaternion w, x, y, z");
  EXPECT_THAT(message({1e300, 0.0, 0.0, 0.0}), HasSubstr("norm"));
  EXPECT_THAT(message({std::nan(""), 0.0, 0.0, 0.0}), HasSubstr("norm nan"));
  const std::array<double, 4> rounded = {0.7071, 0.7071, 0.0, 0.0};
  EXPECT_NEAR(UnitQuaternion(rounded, "", "").norm(), 1.0, 1e-15);
}

TEST(CheckCamera, NumbersOfNoCameraAreRefused) {
  const auto message = [](const std::string& model, std::vector<double> params, int width = 640) {
    const CameraIntrinsics camera{model, width, 480, std::move(params)};
    return Message([&] { camera.Validate("c.json", "camera"); });
  };
  EXPECT_EQ(message("PINHOLE", {500, 500, 320, 240}), "");
  EXPECT_EQ(message("PINHOLE", {500, 500, -900, 240}), "");  // a picture cut from a larger one
  EXPECT_EQ(message("PINHOLE", {500, 500, 1e300, 240}),
            "c.json: camera.params[2]: got 1e+300, expected a principal point in pixels, in the "
            "picture or near it");
  EXPECT_THAT(message("SIMPLE_RADIAL", {500, 320, 240, 1e300}),
              HasSubstr("camera.params[3]: got 1e+300, expected a parameter of distortion"));
  EXPECT_THAT(message("PINHOLE", {2e9, 2e9, 1e9, 240}, 2'000'000'000),
              HasSubstr("camera: limit: got 2000000000 x 480 px, expected at most 200000000 px"));
}

}  // namespace
}  // namespace ridgeline
