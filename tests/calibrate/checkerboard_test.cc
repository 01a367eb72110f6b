// SPDX-License-Identifier: Apache-2.0
#include "calibrate/checkerboard.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "base/error.h"

namespace ridgeline {
namespace {

constexpr double kSquareM = 0.03;
const CameraIntrinsics kCamera{
    "OPENCV", 640, 480, {520.0, 515.0, 318.0, 243.0, -0.12, 0.03, 0.001, -0.0005}};

CheckerboardOptions Board() {
  CheckerboardOptions options;
  options.columns = 8;
  options.rows = 6;
  return options;
}

// A board of 9 x 7 squares with a white border, seen by the camera: each pixel's rays meet its plane.
cv::Mat Picture(const Eigen::Matrix3d& cam_from_board, const Eigen::Vector3d& shift) {
  constexpr int kFine = 3;
  cv::Mat picture(kCamera.height, kCamera.width, CV_8U);
  const Eigen::Vector3d normal = cam_from_board.col(2);
  for (int y = 0; y < picture.rows; ++y) {
    for (int x = 0; x < picture.cols; ++x) {
      int sum = 0;
      for (int k = 0; k < kFine * kFine; ++k) {
        const Eigen::Vector2d ray = kCamera.Undistort(
            {x + (k % kFine + 0.5) / kFine, y + (k / kFine + 0.5) / kFine});
        const Eigen::Vector3d direction(ray.x(), ray.y(), 1.0);
        const Eigen::Vector3d hit = direction * (normal.dot(shift) / normal.dot(direction));
        const Eigen::Vector3d on = cam_from_board.transpose() * (hit - shift);
        const double u = on.x() / kSquareM, v = on.y() / kSquareM;
        const bool inside = u > -1.0 && u < 8.0 && v > -1.0 && v < 6.0;
        const bool black = inside && (static_cast<int>(std::floor(u)) +
                                      static_cast<int>(std::floor(v))) % 2 == 0;
        sum += black ? 25 : inside || (u > -2.0 && u < 9.0 && v > -2.0 && v < 7.0) ? 235 : 120;
      }
      picture.at<std::uint8_t>(y, x) = static_cast<std::uint8_t>(sum / (kFine * kFine));
    }
  }
  return picture;
}

std::vector<BoardView> Views() {
  std::vector<BoardView> views;
  const Eigen::Vector3d middle(3.5 * kSquareM, 2.5 * kSquareM, 0.0);
  int i = 0;
  for (const auto& [tilt, pan, x, y, z] :
       {std::tuple{0.0, 0.0, 0.0, 0.0, 0.42},  {25.0, 0.0, 0.06, 0.0, 0.45},
        {-25.0, 0.0, -0.06, 0.03, 0.45},       {0.0, 30.0, 0.0, 0.05, 0.45},
        {0.0, -30.0, 0.08, -0.05, 0.48},       {20.0, 20.0, -0.08, -0.05, 0.5},
        {-20.0, 20.0, 0.1, 0.06, 0.52},        {15.0, -25.0, -0.1, 0.06, 0.5}}) {
    const double rad = M_PI / 180.0;
    const Eigen::Matrix3d turn =
        (Eigen::AngleAxisd(tilt * rad, Eigen::Vector3d::UnitX()) *
         Eigen::AngleAxisd(pan * rad, Eigen::Vector3d::UnitY())).toRotationMatrix();
    const auto view = FindBoard(Picture(turn, Eigen::Vector3d(x, y, z) - turn * middle),
                                std::to_string(i++),
                                Board());
    if (view) views.push_back(*view);
  }
  return views;
}

TEST(CalibrateCamera, FindsTheCameraAgain) {
  const std::vector<BoardView> views = Views();
  ASSERT_GE(views.size(), 6u);
  const Calibration found = CalibrateCamera(views, kCamera.width, kCamera.height, Board());
  EXPECT_LT(found.rms_px, 0.2);
  ASSERT_EQ(found.camera.model, "OPENCV");
  EXPECT_NEAR(found.camera.params[0], 520.0, 5.0);
  EXPECT_NEAR(found.camera.params[1], 515.0, 5.0);
  EXPECT_NEAR(found.camera.params[2], 318.0, 4.0);
  EXPECT_NEAR(found.camera.params[3], 243.0, 4.0);
  // Where the board was, rays go where they do with the true camera, to half a pixel.
  for (const Eigen::Vector2d& px : {Eigen::Vector2d(200, 150), {450, 330}, {320, 240}}) {
    EXPECT_LT((found.camera.Distort(kCamera.Undistort(px)) - px).norm(), 1.5);
  }
  EXPECT_EQ(found.frames.size(), views.size());
  EXPECT_GT(found.covered, 0.3);
  EXPECT_NO_THROW(found.camera.Validate("camera.json", "camera"));
}

TEST(CalibrateCamera, UsesTheViewsThatDifferMost) {
  std::vector<BoardView> views = Views();
  const std::size_t different = views.size();
  for (int i = 0; i < 20; ++i) views.push_back(views.front());
  CheckerboardOptions options = Board();
  EXPECT_EQ(CalibrateCamera(views, 640, 480, options).frames.size(), different);
  options.max_views = 5;
  EXPECT_EQ(CalibrateCamera(views, 640, 480, options).frames.size(), 5u);
}

TEST(CalibrateCamera, TooFewViewsAreRefused) {
  std::vector<BoardView> views = Views();
  const BoardView one = views.front();
  EXPECT_THROW(CalibrateCamera({one, one}, 640, 480, Board()), InputError);
  EXPECT_THROW(CalibrateCamera({one, one, one, one, one, one}, 640, 480, Board()), InputError);
  EXPECT_FALSE(FindBoard(cv::Mat(480, 640, CV_8U, cv::Scalar(90)), "grey", Board()));
}

TEST(CheckerboardOptions, BadValuesAreNamed) {
  CheckerboardOptions options = Board();
  options.rows = options.columns;
  EXPECT_THROW(options.Validate(), InputError);
  options = Board();
  options.model = "fisheye";
  EXPECT_THROW(options.Validate(), InputError);
}

}  // namespace
}  // namespace ridgeline
