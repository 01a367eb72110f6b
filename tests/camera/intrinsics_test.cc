// SPDX-License-Identifier: Apache-2.0
#include "camera/intrinsics.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>

#include "base/error.h"
#include "base/random.h"

namespace ridgeline {
namespace {

CameraIntrinsics OpenCvCamera() {
  return {"OPENCV", 1280, 960, {1000.0, 1010.0, 640.0, 470.0, -0.2, 0.05, 0.001, -0.002}};
}

std::string MessageOf(const CameraIntrinsics& camera) {
  try {
    camera.Validate("dataset.json", "queries[0].camera");
  } catch (const InputError& e) {
    return e.what();
  }
  return "no error";
}

TEST(CameraIntrinsics, DistortsAsOpenCv) {
  const CameraIntrinsics camera = OpenCvCamera();
  const cv::Matx33d k(1000, 0, 640, 0, 1010, 470, 0, 0, 1);
  const std::vector<double> d = {-0.2, 0.05, 0.001, -0.002};
  Random random(1, HashText("DistortsAsOpenCv"));
  for (int i = 0; i < 200; ++i) {
    const Eigen::Vector2d ray(random.Uniform(-0.6, 0.6), random.Uniform(-0.4, 0.4));
    std::vector<cv::Point2d> projected;
    cv::projectPoints(std::vector<cv::Point3d>{{ray.x(), ray.y(), 1.0}},
                      cv::Vec3d(),
                      cv::Vec3d(),
                      k,
                      d,
                      projected);
    const Eigen::Vector2d px = camera.Distort(ray);
    EXPECT_NEAR(px.x(), projected[0].x, 1e-9);
    EXPECT_NEAR(px.y(), projected[0].y, 1e-9);
    EXPECT_TRUE(camera.Undistort(px).isApprox(ray, 1e-8));
  }
}

TEST(CameraIntrinsics, ModelsReadTheirParametersInColmapsOrder) {
  const CameraIntrinsics simple{"SIMPLE_RADIAL", 100, 80, {90.0, 50.0, 40.0, 0.1}};
  // r^2 = 0.05: x = 0.2 * (1 + 0.1 * 0.05).
  EXPECT_TRUE(
      simple.Distort({0.2, 0.1})
          .isApprox(Eigen::Vector2d(90.0 * 0.2 * 1.005 + 50.0, 90.0 * 0.1 * 1.005 + 40.0), 1e-12));
  const CameraIntrinsics radial{"RADIAL", 100, 80, {90.0, 50.0, 40.0, 0.1, 0.2}};
  EXPECT_NEAR(radial.Distort({0.2, 0.1}).x(), 90.0 * 0.2 * 1.0055 + 50.0, 1e-12);
  const PinholeCamera pinhole =
      CameraIntrinsics{"SIMPLE_PINHOLE", 100, 80, {90.0, 50.0, 40.0}}.Pinhole();
  EXPECT_EQ(pinhole.fx, 90.0);
  EXPECT_EQ(pinhole.fy, 90.0);
  EXPECT_EQ(pinhole.cy, 40.0);
}

TEST(CameraIntrinsics, BadCamerasAreNamed) {
  CameraIntrinsics camera = OpenCvCamera();
  camera.model = "FISHEYE";
  EXPECT_THAT(MessageOf(camera),
              testing::StartsWith("dataset.json: queries[0].camera.model: got "
                                  "\"FISHEYE\", expected one of SIMPLE_PINHOLE"));
  camera = OpenCvCamera();
  camera.params.pop_back();
  EXPECT_EQ(MessageOf(camera),
            "dataset.json: queries[0].camera.params: got 7 numbers, expected 8 for OPENCV");
  camera = OpenCvCamera();
  camera.params[1] = -5.0;
  EXPECT_THAT(MessageOf(camera), testing::HasSubstr("camera.params[1]: got -5"));
  camera = OpenCvCamera();
  camera.width = 0;
  EXPECT_EQ(MessageOf(camera), "dataset.json: queries[0].camera.width: got 0, expected > 0");
}

TEST(CameraIntrinsics, DistortionThatFoldsThePictureIsNone) {
  CameraIntrinsics camera{"SIMPLE_RADIAL", 640, 480, {481.0, 320.0, 240.0, -5.0}};
  EXPECT_THAT(
      MessageOf(camera),
      testing::HasSubstr("camera.params: got a distortion that folds the picture at 21 % of "
                         "the way to its corner, expected that of a lens"));
  camera.params[3] = -0.4;  // a fisheye-like action camera's
  EXPECT_EQ(MessageOf(camera), "no error");
  camera.params[3] = 0.4;
  EXPECT_EQ(MessageOf(camera), "no error");
}

TEST(CameraIntrinsics, FocalLengthsFarApartAreNamed) {
  const CameraIntrinsics camera{"PINHOLE", 640, 480, {481.0, 1100.0, 320.0, 240.0}};
  EXPECT_THAT(MessageOf(camera), testing::HasSubstr("camera.params[1]: got 1100 beside 481"));
}

TEST(PinholeCamera, ScaledKeepsRays) {
  const PinholeCamera camera{1281, 961, 1000.0, 990.0, 640.0, 470.0};
  const PinholeCamera half = camera.Scaled(0.5);
  const Eigen::Vector3d point(1.0, -0.5, 4.0);
  const Eigen::Vector2d full_px = camera.ImageFromCamera(point);
  const Eigen::Vector2d half_px = half.ImageFromCamera(point);
  EXPECT_NEAR(half_px.x() / half.width, full_px.x() / camera.width, 1e-12);
  EXPECT_NEAR(half_px.y() / half.height, full_px.y() / camera.height, 1e-12);
  EXPECT_TRUE(camera.RayFromImage(full_px).isApprox(point / point.z(), 1e-12));
}

// Pixels hold their own column or row, so that what comes out is where it came from.
TEST(UndistortImage, TakesEveryPixelFromItsDistortedPlace) {
  const CameraIntrinsics camera = OpenCvCamera();
  cv::Mat columns(960, 1280, CV_32F);
  cv::Mat rows(columns.size(), CV_32F);
  for (int y = 0; y < columns.rows; ++y) {
    for (int x = 0; x < columns.cols; ++x) {
      columns.at<float>(y, x) = static_cast<float>(x);
      rows.at<float>(y, x) = static_cast<float>(y);
    }
  }
  const cv::Mat x_of = UndistortImage(columns, camera);
  const cv::Mat y_of = UndistortImage(rows, camera);
  // cv::remap rounds to 1 / 32 px.
  constexpr double kTolerancePx = 0.5 / 32.0 + 0.01;
  int inside = 0;
  for (int y = 0; y < columns.rows; y += 3) {
    for (int x = 0; x < columns.cols; x += 5) {
      const Eigen::Vector2d px =
          camera.Distort(camera.Pinhole().RayFromImage({x + 0.5, y + 0.5}).head<2>());
      if (px.x() < 1.0 || px.y() < 1.0 || px.x() > 1279.0 || px.y() > 959.0) continue;
      ++inside;
      ASSERT_NEAR(x_of.at<float>(y, x), px.x() - 0.5, kTolerancePx) << x << ", " << y;
      ASSERT_NEAR(y_of.at<float>(y, x), px.y() - 0.5, kTolerancePx) << x << ", " << y;
    }
  }
  EXPECT_GT(inside, 60000);
}

TEST(UndistortImage, MovesABrightDotToItsPinholePlace) {
  const CameraIntrinsics camera = OpenCvCamera();
  const Eigen::Vector3d ray(0.45, 0.3, 1.0);
  const Eigen::Vector2d distorted = camera.Distort(ray.head<2>());
  cv::Mat image(camera.height, camera.width, CV_8U, cv::Scalar(0));
  const int x = static_cast<int>(distorted.x());
  const int y = static_cast<int>(distorted.y());
  image(cv::Rect(x - 2, y - 2, 5, 5)) = 255;
  const cv::Mat undistorted = UndistortImage(image, camera);
  const cv::Moments m = cv::moments(undistorted);
  const Eigen::Vector2d expected = camera.Pinhole().ImageFromCamera(ray);
  // The dot is drawn to whole pixels.
  EXPECT_NEAR(m.m10 / m.m00 + 0.5, expected.x(), 1.0);
  EXPECT_NEAR(m.m01 / m.m00 + 0.5, expected.y(), 1.0);
}

}  // namespace
}  // namespace ridgeline
