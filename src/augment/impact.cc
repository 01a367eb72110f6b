// SPDX-License-Identifier: Apache-2.0
#include "augment/impact.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "score/foliage_mask.h"
#include "skyline/sky_likelihood.h"

namespace ridgeline {
namespace {

// Coverage from which a pixel belongs to the building.
constexpr int kCovered = 128;

// CV_8U, 255 where the model shows sky. Beyond the model and the terrain the ground goes on to the
// horizon.
cv::Mat ModelSky(const Scene& city, const PinholeCamera& camera, const Pose& pose) {
  const ViewBuffers view = city.Render(camera, pose);
  cv::Mat sky = cv::Mat::zeros(camera.height, camera.width, CV_8U);
  const Eigen::Quaterniond local_from_cam = pose.cam_from_world.conjugate();
  for (int y = 0; y < camera.height; ++y) {
    for (int x = 0; x < camera.width; ++x) {
      if (view.surfaces[static_cast<std::size_t>(y) * camera.width + x] != kNoSurface) continue;
      const Eigen::Vector3d ray = local_from_cam * camera.RayFromImage({x + 0.5, y + 0.5});
      if (ray.z() > 0.0) sky.at<std::uint8_t>(y, x) = 255;
    }
  }
  return sky;
}

// Positions in the picture of the corners of a box; nothing if one is not before the camera.
std::optional<std::array<Eigen::Vector2d, 8>> CornersSeen(const Eigen::AlignedBox3d& box,
                                                          const PinholeCamera& camera,
                                                          const Pose& pose) {
  constexpr double kNearM = 1.0;
  std::array<Eigen::Vector2d, 8> seen;
  for (int k = 0; k < 8; ++k) {
    const Eigen::Vector3d p =
        pose.CameraFromWorld(box.corner(static_cast<Eigen::AlignedBox3d::CornerType>(k)));
    if (p.z() < kNearM) return std::nullopt;
    seen[static_cast<std::size_t>(k)] = camera.ImageFromCamera(p);
  }
  return seen;
}

}  // namespace

SkyImpact ImpactOf(const Scene& city,
                   const PinholeCamera& camera,
                   const Pose& cam_from_local,
                   const cv::Mat& coverage) {
  SkyImpact impact;
  const cv::Mat sky = ModelSky(city, camera, cam_from_local);
  const double before = cv::countNonZero(sky);
  impact.sky_before = before / static_cast<double>(sky.total());
  const cv::Mat lost = (coverage >= kCovered) & sky;
  if (before > 0.0) impact.sky_lost = cv::countNonZero(lost) / before;
  int raised = 0;
  double sum = 0.0;
  for (int x = 0; x < sky.cols; ++x) {
    int first = 0;
    while (first < sky.rows && sky.at<std::uint8_t>(first, x) != 0) ++first;
    int after = 0;
    while (after < first && coverage.at<std::uint8_t>(after, x) < kCovered) ++after;
    impact.before.push_back(first);
    impact.after.push_back(after);
    if (after == first) continue;
    ++raised;
    sum += first - after;
    impact.highest_rise_px = std::max(impact.highest_rise_px, static_cast<double>(first - after));
  }
  impact.raised_columns = static_cast<double>(raised) / sky.cols;
  if (raised > 0) impact.mean_rise_px = sum / raised;
  return impact;
}

std::string ImpactCsv(const SkyImpact& impact) {
  std::string csv = "x_px,y_before_px,y_after_px\n";
  for (std::size_t x = 0; x < impact.before.size(); ++x) {
    csv += std::to_string(x) + ',' + std::to_string(impact.before[x]) + ',' +
           std::to_string(impact.after[x]) + '\n';
  }
  return csv;
}

cv::Mat AutomaticForeground(const cv::Mat& photo,
                            const Scene& city,
                            const PinholeCamera& camera,
                            const Pose& cam_from_local) {
  cv::Mat odds;
  cv::resize(
      SkyLogOdds(photo, SkyLikelihoodOptions{}), odds, photo.size(), 0.0, 0.0, cv::INTER_LINEAR);
  // The model's outline is off by some pixels: what lies that near to it belongs to it.
  const int margin = std::max(3, photo.cols / 80) | 1;
  cv::Mat sky = ModelSky(city, camera, cam_from_local);
  cv::erode(sky, sky, cv::getStructuringElement(cv::MORPH_RECT, {margin, margin}));
  const cv::Mat covered = (odds < 0.0f) & sky;
  cv::Mat mask = covered | (FoliageMask(photo) != 0);
  cv::morphologyEx(
      mask, mask, cv::MORPH_OPEN, cv::getStructuringElement(cv::MORPH_ELLIPSE, {3, 3}));
  return mask;
}

InsertionStability StabilityOf(std::span<const InsertedFrame> frames, const TexturedMesh& mesh) {
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d& v : mesh.vertices) box.extend(v);
  InsertionStability result;
  double sum = 0.0, squares = 0.0;
  Eigen::Vector2d last = Eigen::Vector2d::Zero();
  bool has_last = false;
  for (const InsertedFrame& frame : frames) {
    Eigen::Vector2d offset = Eigen::Vector2d::Zero();
    bool is_known = false;
    if (frame.pose && frame.truth) {
      const auto drawn = CornersSeen(box, frame.camera, *frame.pose);
      const auto right = CornersSeen(box, frame.camera, *frame.truth);
      if (drawn && right) {
        is_known = true;
        double error = 0.0;
        for (std::size_t k = 0; k < 8; ++k) {
          offset += ((*drawn)[k] - (*right)[k]) / 8.0;
          error += ((*drawn)[k] - (*right)[k]).norm() / 8.0;
        }
        ++result.frames;
        sum += error;
        result.worst_error_px = std::max(result.worst_error_px, error);
      }
    }
    if (is_known && has_last) {
      ++result.steps;
      squares += (offset - last).squaredNorm();
    }
    last = offset;
    has_last = is_known;
  }
  if (result.frames > 0) result.mean_error_px = sum / result.frames;
  if (result.steps > 0) result.jitter_px = std::sqrt(squares / result.steps);
  return result;
}

}  // namespace ridgeline
