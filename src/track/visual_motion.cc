// SPDX-License-Identifier: Apache-2.0
#include "track/visual_motion.h"

#include <algorithm>
#include <cmath>
#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>
#include <opencv2/video/tracking.hpp>

namespace ridgeline {
namespace {

constexpr int kSidePx = 800;
constexpr int kCorners = 600;
constexpr int kLeastCorners = 40;
// A camera stands if half of the corners move less.
constexpr double kStandingPx = 0.4;
constexpr double kInlierPx = 1.0;
// Corners that come back to this near of where they were followed from are followed well.
constexpr double kReturnPx = 1.0;
// Pictures whose small copies correlate less, and of which no corner is followed, are a cut.
constexpr double kLikeness = 0.5;
constexpr double kLeastZoom = 0.03;
// Deviations of a rotation, and of the direction of a step as a share of its length.
constexpr double kSigmaDeg = 0.4;
constexpr double kAside = 0.08;

struct Flow {
  std::vector<cv::Point2f> from, to;
};

Flow Follow(const cv::Mat& before, const cv::Mat& now) {
  Flow flow;
  std::vector<cv::Point2f> from, to, back;
  cv::goodFeaturesToTrack(before, from, kCorners, 0.01, 8.0);
  if (from.empty()) return flow;
  std::vector<uchar> there, returned;
  std::vector<float> errors;
  const cv::Size window(21, 21);
  constexpr int kLevels = 5;
  cv::calcOpticalFlowPyrLK(before, now, from, to, there, errors, window, kLevels);
  cv::calcOpticalFlowPyrLK(now, before, to, back, returned, errors, window, kLevels);
  for (std::size_t i = 0; i < from.size(); ++i) {
    if (there[i] == 0 || returned[i] == 0 || cv::norm(back[i] - from[i]) > kReturnPx) continue;
    flow.from.push_back(from[i]);
    flow.to.push_back(to[i]);
  }
  return flow;
}

double Likeness(const cv::Mat& a, const cv::Mat& b) {
  cv::Mat small_a, small_b, result;
  cv::resize(a, small_a, {32, 24}, 0.0, 0.0, cv::INTER_AREA);
  cv::resize(b, small_b, {32, 24}, 0.0, 0.0, cv::INTER_AREA);
  cv::matchTemplate(small_a, small_b, result, cv::TM_CCOEFF_NORMED);
  return result.at<float>(0, 0);
}

// The growth about the middle, where it explains nearly all of the flow.
std::optional<double> ZoomOf(const Flow& flow) {
  cv::Mat inliers;
  const cv::Mat m =
      cv::estimateAffinePartial2D(flow.from, flow.to, inliers, cv::RANSAC, 1.5, 1000, 0.99);
  if (m.empty()) return std::nullopt;
  const double share = cv::countNonZero(inliers) / static_cast<double>(flow.from.size());
  const double zoom = std::hypot(m.at<double>(0, 0), m.at<double>(1, 0));
  constexpr double kNearlyAll = 0.9;
  if (share < kNearlyAll || std::abs(std::log(zoom)) < kLeastZoom) return std::nullopt;
  return zoom;
}

}  // namespace

VisualMotion::Result VisualMotion::Next(const cv::Mat& bgr, const PinholeCamera& camera) {
  Result result;
  const double scale = std::min(1.0, static_cast<double>(kSidePx) / std::max(bgr.cols, bgr.rows));
  const PinholeCamera reduced = camera.Scaled(scale);
  cv::Mat grey, now;
  cv::cvtColor(bgr, grey, cv::COLOR_BGR2GRAY);
  cv::resize(grey, now, {reduced.width, reduced.height}, 0.0, 0.0, cv::INTER_AREA);
  const cv::Mat before = before_;
  before_ = now;
  const bool same_camera = camera_.width == reduced.width && camera_.height == reduced.height;
  camera_ = reduced;
  if (before.empty() || !same_camera) {
    result.missing = before.empty() ? "there is no picture before" : "the pictures differ in size";
    return result;
  }
  const Flow flow = Follow(before, now);
  result.followed = static_cast<int>(flow.from.size());
  if (result.followed < kLeastCorners) {
    result.is_cut = Likeness(before, now) < kLikeness;
    result.missing = std::to_string(result.followed) + " corners could be followed, " +
                     std::to_string(kLeastCorners) + " are the least";
    return result;
  }
  std::vector<double> lengths;
  for (std::size_t i = 0; i < flow.from.size(); ++i) {
    lengths.push_back(cv::norm(flow.to[i] - flow.from[i]));
  }
  std::nth_element(
      lengths.begin(), lengths.begin() + static_cast<std::ptrdiff_t>(lengths.size() / 2), lengths.end());
  Motion motion;
  motion.sigma_deg = kSigmaDeg;
  motion.sigma_m = kAside;
  if (lengths[lengths.size() / 2] < kStandingPx) {
    result.is_standing = true;
    result.motion = motion;
    return result;
  }
  result.zoom = ZoomOf(flow);
  const cv::Matx33d k(
      reduced.fx, 0, reduced.cx - 0.5, 0, reduced.fy, reduced.cy - 0.5, 0, 0, 1);
  cv::Mat inliers, r, t;
  cv::setRNGSeed(1);  // the same result for the same pictures
  const cv::Mat essential = cv::findEssentialMat(
      flow.from, flow.to, k, cv::RANSAC, 0.999, kInlierPx, inliers);
  const int agreeing =
      essential.rows == 3
          ? cv::recoverPose(essential, flow.from, flow.to, k, r, t, inliers)
          : 0;
  if (agreeing < kLeastCorners / 2) {
    result.missing = "the corners do not agree on one motion";
    return result;
  }
  Eigen::Matrix3d rotation;
  for (int i = 0; i < 9; ++i) rotation(i / 3, i % 3) = r.at<double>(i / 3, i % 3);
  motion.now_from_before = Eigen::Quaterniond(rotation).normalized();
  // x_now = R x_before + t: the centre of now in the axes of before is -R' t.
  motion.step_in_before =
      -(rotation.transpose() *
        Eigen::Vector3d(t.at<double>(0), t.at<double>(1), t.at<double>(2)));
  result.motion = motion;
  return result;
}

}  // namespace ridgeline
