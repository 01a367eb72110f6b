// SPDX-License-Identifier: Apache-2.0
#include "calibrate/checkerboard.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>

#include "base/error.h"

namespace ridgeline {
namespace {

constexpr std::size_t kLeastViews = 5;
constexpr int kCells = 6;  // of the grid of covered

void Refuse(const char* option, const std::string& found, const char* expected) {
  throw InputError(option, "", found, expected);
}

std::vector<cv::Point3f> BoardPoints(const CheckerboardOptions& options) {
  std::vector<cv::Point3f> points;
  for (int row = 0; row < options.rows; ++row) {
    for (int column = 0; column < options.columns; ++column) {
      // In squares: the size of the board does not change the camera.
      points.emplace_back(static_cast<float>(column), static_cast<float>(row), 0.0f);
    }
  }
  return points;
}

// Where and how the board appears: its four outer corners, as a vector.
std::array<double, 8> Appearance(const BoardView& view, const CheckerboardOptions& options) {
  const std::size_t across = static_cast<std::size_t>(options.columns);
  const std::size_t last = view.corners.size() - 1;
  std::array<double, 8> appearance{};
  std::size_t k = 0;
  for (const std::size_t i : {std::size_t{0}, across - 1, last - across + 1, last}) {
    appearance[k++] = view.corners[i].x;
    appearance[k++] = view.corners[i].y;
  }
  return appearance;
}

// Views that differ most from each other: farthest points first.
std::vector<std::size_t> MostDifferent(const std::vector<BoardView>& views,
                                       const CheckerboardOptions& options) {
  std::vector<std::array<double, 8>> appearances;
  for (const BoardView& view : views) appearances.push_back(Appearance(view, options));
  std::vector<double> nearest(views.size(), std::numeric_limits<double>::infinity());
  std::vector<std::size_t> chosen;
  std::size_t next = 0;
  const std::size_t count = std::min(views.size(), static_cast<std::size_t>(options.max_views));
  while (chosen.size() < count) {
    chosen.push_back(next);
    for (std::size_t i = 0; i < views.size(); ++i) {
      double squared = 0.0;
      for (std::size_t k = 0; k < 8; ++k) {
        squared += std::pow(appearances[i][k] - appearances[next][k], 2);
      }
      nearest[i] = std::min(nearest[i], squared);
    }
    next = static_cast<std::size_t>(std::max_element(nearest.begin(), nearest.end()) -
                                    nearest.begin());
    if (nearest[next] == 0.0) break;  // the rest are the same again
  }
  std::sort(chosen.begin(), chosen.end());
  return chosen;
}

double CoveredShare(const std::vector<std::vector<cv::Point2f>>& corners, int width, int height) {
  std::array<bool, kCells * kCells> seen{};
  for (const auto& view : corners) {
    for (const cv::Point2f& p : view) {
      const int x = std::clamp(static_cast<int>(p.x * kCells / width), 0, kCells - 1);
      const int y = std::clamp(static_cast<int>(p.y * kCells / height), 0, kCells - 1);
      seen[static_cast<std::size_t>(y) * kCells + x] = true;
    }
  }
  return static_cast<double>(std::count(seen.begin(), seen.end(), true)) / seen.size();
}

int FlagsOf(const std::string& model) {
  if (model == "opencv") return cv::CALIB_FIX_K3;
  const int one_focal = cv::CALIB_FIX_K3 | cv::CALIB_ZERO_TANGENT_DIST | cv::CALIB_FIX_ASPECT_RATIO;
  if (model == "radial") return one_focal;
  return one_focal | cv::CALIB_FIX_K1 | cv::CALIB_FIX_K2;
}

// COLMAP's pixels start at the corner of the first one.
CameraIntrinsics CameraOf(const cv::Mat& k,
                          const cv::Mat& d,
                          int width,
                          int height,
                          const std::string& model) {
  CameraIntrinsics camera;
  camera.width = width;
  camera.height = height;
  const double fx = k.at<double>(0, 0), fy = k.at<double>(1, 1);
  const double cx = k.at<double>(0, 2) + 0.5, cy = k.at<double>(1, 2) + 0.5;
  if (model == "opencv") {
    camera.model = "OPENCV";
    camera.params = {fx, fy, cx, cy, d.at<double>(0), d.at<double>(1), d.at<double>(2),
                     d.at<double>(3)};
  } else if (model == "radial") {
    camera.model = "RADIAL";
    camera.params = {fx, cx, cy, d.at<double>(0), d.at<double>(1)};
  } else {
    camera.model = "SIMPLE_PINHOLE";
    camera.params = {fx, cx, cy};
  }
  return camera;
}

}  // namespace

void CheckerboardOptions::Validate() const {
  if (columns < 3 || rows < 3 || columns > 100 || rows > 100) {
    Refuse("--board",
           std::to_string(columns) + "x" + std::to_string(rows),
           "inner corners across and down, e.g. 9x6");
  }
  if (columns == rows) {
    Refuse("--board",
           std::to_string(columns) + "x" + std::to_string(rows),
           "unequal numbers: a square board has no top");
  }
  if (max_views < static_cast<int>(kLeastViews)) {
    Refuse("--views", std::to_string(max_views), "at least 5");
  }
  if (model != "opencv" && model != "radial" && model != "pinhole") {
    Refuse("--lens", '"' + model + '"', "opencv, radial or pinhole");
  }
}

std::optional<BoardView> FindBoard(const cv::Mat& picture,
                                   const std::string& frame,
                                   const CheckerboardOptions& options) {
  cv::Mat gray = picture;
  if (picture.channels() > 1) cv::cvtColor(picture, gray, cv::COLOR_BGR2GRAY);
  const cv::Size size(options.columns, options.rows);
  BoardView view;
  view.frame = frame;
  const int flags =
      cv::CALIB_CB_ADAPTIVE_THRESH | cv::CALIB_CB_NORMALIZE_IMAGE | cv::CALIB_CB_FAST_CHECK;
  if (!cv::findChessboardCorners(gray, size, view.corners, flags)) return std::nullopt;
  // No farther than a third of the way to the next corner.
  const double spacing = cv::norm(view.corners[1] - view.corners[0]);
  const int window = std::clamp(static_cast<int>(spacing / 3.0), 2, 11);
  cv::cornerSubPix(gray,
                   view.corners,
                   cv::Size(window, window),
                   cv::Size(-1, -1),
                   {cv::TermCriteria::EPS | cv::TermCriteria::COUNT, 50, 1e-3});
  return view;
}

Calibration CalibrateCamera(const std::vector<BoardView>& views,
                            int width,
                            int height,
                            const CheckerboardOptions& options) {
  options.Validate();
  if (views.size() < kLeastViews) {
    throw InputError("FRAMES",
                     "",
                     "the whole board in " + std::to_string(views.size()) + " frames",
                     "at least 5, tilted in different ways; --board counts inner corners");
  }
  Calibration result;
  std::vector<std::vector<cv::Point2f>> corners;
  for (const std::size_t i : MostDifferent(views, options)) {
    corners.push_back(views[i].corners);
    result.frames.push_back(views[i].frame);
  }
  if (corners.size() < kLeastViews) {
    throw InputError("FRAMES",
                     "",
                     std::to_string(corners.size()) + " different views of the board",
                     "at least 5: move the board or the camera");
  }
  const std::vector<std::vector<cv::Point3f>> board(corners.size(), BoardPoints(options));
  cv::Mat k = cv::Mat::eye(3, 3, CV_64F), d, rotations, shifts, sigma, sigma_poses, errors;
  result.rms_px = cv::calibrateCamera(board,
                                      corners,
                                      cv::Size(width, height),
                                      k,
                                      d,
                                      rotations,
                                      shifts,
                                      sigma,
                                      sigma_poses,
                                      errors,
                                      FlagsOf(options.model));
  result.camera = CameraOf(k, d, width, height, options.model);
  for (int i = 0; i < 4; ++i) result.sigma_px[i] = sigma.at<double>(i);
  for (int i = 0; i < errors.rows; ++i) result.frame_rms_px.push_back(errors.at<double>(i));
  result.covered = CoveredShare(corners, width, height);
  return result;
}

}  // namespace ridgeline
