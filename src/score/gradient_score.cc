// SPDX-License-Identifier: Apache-2.0
#include "score/gradient_score.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <opencv2/imgproc.hpp>
#include <string>

#include "lines/line_detector.h"
#include "score/edge_samples.h"
#include "score/score_plugin.h"

namespace ridgeline {
namespace {

constexpr int kGradientDirections = OrientedDistanceField::kDirections;
constexpr int kLevels = 4096;  // of gradients, up to the picture's largest
// Smaller gradients are rounding [grey values / px].
constexpr float kNoise = 0.02f;

}  // namespace

GradientScore::GradientScore(const cv::Mat& picture,
                             const PinholeCamera& camera,
                             const GradientScoreOptions& options)
    : camera_(camera), spacing_px_(static_cast<float>(options.spacing_width * camera.width)) {
  cv::Mat gray;
  cv::resize(
      GrayOf(picture), gray, cv::Size(camera.width, camera.height), 0.0, 0.0, cv::INTER_AREA);
  gray.convertTo(gray, CV_32F);
  cv::GaussianBlur(gray, gray, cv::Size(), options.sigma_width * camera.width);
  cv::Mat gx;
  cv::Mat gy;
  cv::Sobel(gray, gx, CV_32F, 1, 0, 3, 0.125);
  cv::Sobel(gray, gy, CV_32F, 0, 1, 3, 0.125);
  cv::Mat magnitude;
  cv::magnitude(gx, gy, magnitude);
  double largest = 0.0;
  cv::minMaxLoc(magnitude, nullptr, &largest);
  has_gradients_ = largest > kNoise;
  if (!has_gradients_) return;

  const std::size_t pixels = magnitude.total();
  const float scale = static_cast<float>((kLevels - 1) / largest);
  std::vector<std::uint16_t> levels(kGradientDirections * pixels);
  std::array<std::uint64_t, kLevels + 1> smaller{};  // first counts, then sums
  for (int direction = 0; direction < kGradientDirections; ++direction) {
    // Across the middle of the direction bin.
    const float angle =
        (static_cast<float>(direction) + 0.5f) * std::numbers::pi_v<float> / kGradientDirections;
    const float nx = -std::sin(angle);
    const float ny = std::cos(angle);
    const float* x = gx.ptr<float>();
    const float* y = gy.ptr<float>();
    const float* m = magnitude.ptr<float>();
    for (std::size_t i = 0; i < pixels; ++i) {
      // The fourth power of the cosine: a strong edge is nothing to an edge across it, although the
      // bin's direction is off by some degrees.
      const float cosine = m[i] > kNoise ? (nx * x[i] + ny * y[i]) / m[i] : 0.0f;
      const float across = m[i] * cosine * cosine * cosine * cosine;
      const auto level = static_cast<std::uint16_t>(std::min<float>(across * scale, kLevels - 1));
      levels[direction * pixels + i] = level;
      ++smaller[level + 1];
    }
  }
  for (int level = 0; level < kLevels; ++level) smaller[level + 1] += smaller[level];
  ranks_.resize(levels.size());
  const double total = static_cast<double>(levels.size());
  for (std::size_t i = 0; i < levels.size(); ++i) {
    ranks_[i] = static_cast<std::uint8_t>(std::lround(255.0 * smaller[levels[i]] / total));
  }
}

double GradientScore::EnergyOfEdges(std::span<const ProjectedSegment> segments) const {
  if (!has_gradients_) return 1.0;
  const std::size_t pixels = static_cast<std::size_t>(camera_.width) * camera_.height;
  const double mean = MeanAlongEdges(
      segments, spacing_px_, camera_.width, camera_.height, [&](int direction, int x, int y) {
        return static_cast<double>(
            ranks_[direction * pixels + static_cast<std::size_t>(y) * camera_.width + x]);
      });
  return mean < 0.0 ? 1.0 : 1.0 - mean / 255.0;
}

double GradientScore::LogRatio(const PositionView& view,
                               const Pose& cam_from_local,
                               Workspace& workspace) const {
  ProjectPieces(view.visible, camera_, cam_from_local, workspace.segments);
  return LogRatioOf(EnergyOfEdges(workspace.segments));
}

extern const ScorePlugin kGradientScore;
constinit const ScorePlugin kGradientScore = {
    .name = "gradient",
    .declare = [](OptionGroups& options) { options.Add<GradientScoreOptions>("gradient"); },
    .make = [](const ScoreContext& c) -> std::unique_ptr<Score> {
      return std::make_unique<GradientScore>(
          c.picture.full_bgr(), c.picture.camera(), c.options.groups.Get<GradientScoreOptions>());
    }};

}  // namespace ridgeline
