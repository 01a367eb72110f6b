// SPDX-License-Identifier: Apache-2.0
#include "convert/camera_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "convert_test_folder.h"

namespace ridgeline {
namespace {

using ::testing::DoubleNear;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

class CameraFiles : public ::ridgeline::testing::ConvertTest {
 protected:
  CameraFile Read(const std::string& text) const {
    return ReadCameraFile(Write("camera_parameters.txt", text), 960, 1280);
  }
  std::string ErrorOf(const std::string& text) const {
    return Message([&] { Read(text); });
  }
};

TEST_F(CameraFiles, WordsAndNumbersInManySpellings) {
  for (const char* text : {"fx 1000\nfy 1002\ncx 480.5\ncy 641\n",
                           "# a phone\nfx: 1000\nfy: 1002\ncx: 480.5\ncy: 641\n",
                           "fx = 1000.0 px\nfy = 1.002e3 px\ncx = 480.5\ncy = 641\n",
                           "Focal length (px): 1000, 1002\nPrincipal point: 480.5 641\n",
                           "fx,fy,cx,cy\n1000,1002,480.5,641\n",
                           "image size 960 x 1280\nfocal_length_x 1000\nfocal_length_y 1002\n"
                           "principal_point_x 480.5\nprincipal_point_y 641\n",
                           "1000 0 480.5\n0 1002 641\n0 0 1\n",
                           "K: [[1000, 0, 480.5], [0, 1002, 641], [0, 0, 1]]\n",
                           "1 PINHOLE 960 1280 1000 1002 480.5 641\n"}) {
    const CameraIntrinsics camera = Read(text).common.value();
    EXPECT_EQ(camera.model, "PINHOLE") << text;
    EXPECT_EQ(camera.width, 960) << text;
    EXPECT_EQ(camera.height, 1280) << text;
    EXPECT_THAT(camera.params, ElementsAre(1000.0, 1002.0, 480.5, 641.0)) << text;
  }
}

TEST_F(CameraFiles, DistortionIsBrowns) {
  const CameraIntrinsics two =
      Read("f 1000\ncx 480\ncy 640\nk1 0.05\nk2 -0.1\np1 0.001\np2 -0.002\n").common.value();
  EXPECT_EQ(two.model, "OPENCV");
  EXPECT_THAT(two.params, ElementsAre(1000, 1000, 480, 640, 0.05, -0.1, 0.001, -0.002));
  const CameraIntrinsics three =
      Read("f 1000\ncx 480\ncy 640\nk1 0.05\nk2 -0.1\nk3 0.02\n").common.value();
  EXPECT_EQ(three.model, "FULL_OPENCV");
  EXPECT_THAT(three.params, ElementsAre(1000, 1000, 480, 640, 0.05, -0.1, 0, 0, 0.02, 0, 0, 0));
}

// In the manner of Pix4D's .cam, worked out by hand: 1280 px on 9.6 mm are 133.33 px/mm.
TEST_F(CameraFiles, MillimetresBecomePixelsByTheSensorsSize) {
  const CameraIntrinsics camera = Read(
                                      "Pix4D camera calibration file 0\n"
                                      "#Focal Length mm assuming a sensor width of 7.2x9.6mm\n"
                                      "F 7.5\n#Principal Point mm\nPx 3.6\nPy 4.8\n"
                                      "#Symmetrical Lens Distortion Coeffs\nK1 0.1\nK2 0\nK3 0\n"
                                      "#Tangential Lens Distortion Coeffs\nT1 0\nT2 0\n")
                                      .common.value();
  EXPECT_THAT(camera.params,
              ElementsAre(DoubleNear(1000.0, 1e-9),
                          DoubleNear(1000.0, 1e-9),
                          DoubleNear(480.0, 1e-9),
                          DoubleNear(640.0, 1e-9),
                          0.1,
                          0.0,
                          0.0,
                          0.0));
}

TEST_F(CameraFiles, BlocksOfPix4dGiveEachPictureItsCamera) {
  const std::string tail =
      "0 0 1\n0.1 -0.2 0\n0.001 0.002\n604000.1 5790000.2 75\n"
      "1 0 0\n0 1 0\n0 0 1\n";
  const CameraFile file = Read(
      "fileName imageWidth imageHeight\ncamera matrix K [3x3]\nradial distortion [3x1]\n"
      "tangential distortion [2x1]\ncamera position t [3x1]\ncamera rotation R [3x3]\n"
      "camera model m = K [R|-Rt] X\n\n"
      "a.jpg 1920 2560\n2000 0 960\n0 2000 1280\n" +
      tail + "b.jpg 1920 2560\n2200 0 960\n0 2200 1280\n" + tail);
  EXPECT_FALSE(file.common.has_value());
  // Half the size, half the focal length.
  EXPECT_THAT(file.Of("a.jpg")->params, ElementsAre(1000, 1000, 480, 640, 0.1, -0.2, 0.001, 0.002));
  EXPECT_THAT(file.Of("b.jpg")->params[0], 1100.0);
  EXPECT_FALSE(file.Of("c.jpg").has_value());
}

TEST_F(CameraFiles, WhatCannotBeIsRefused) {
  EXPECT_THAT(ErrorOf("a phone\n"), HasSubstr("no focal length, expected fx, fy, cx, cy"));
  EXPECT_THAT(ErrorOf("F 6.9 mm\nPx 3.6\nPy 4.8\n"), HasSubstr("without the sensor's size"));
  EXPECT_THAT(ErrorOf("fx 7\n"), HasSubstr("got fx 7.0"));
  EXPECT_THAT(ErrorOf("width 1280\nheight 960\nfx 1000\ncx 640\ncy 480\n"),
              HasSubstr("1280 x 960 px, expected the shape of the pictures"));
  EXPECT_THAT(ErrorOf("1 PINHOLE 640 480 500 500 320 240\n"), HasSubstr("640 x 480"));
}

}  // namespace
}  // namespace ridgeline
