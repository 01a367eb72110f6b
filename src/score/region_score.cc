// SPDX-License-Identifier: Apache-2.0
#include "score/region_score.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <opencv2/imgproc.hpp>
#include <string>

#include "base/error.h"

namespace ridgeline {
namespace {

// Bins of about equally many values each; equal values share one.
std::vector<int> RankBins(const std::vector<float>& values, int bins) {
  std::vector<float> sorted = values;
  std::sort(sorted.begin(), sorted.end());
  std::vector<int> result;
  for (const float value : values) {
    const auto below = std::lower_bound(sorted.begin(), sorted.end(), value) - sorted.begin();
    result.push_back(static_cast<int>(below * bins / static_cast<std::ptrdiff_t>(sorted.size())));
  }
  return result;
}

RegionScore::Region RegionOf(std::uint32_t surface, bool is_upward, const CityModel& model) {
  // Beyond the model and the terrain the ground goes on to the horizon.
  if (surface == kNoSurface) return is_upward ? RegionScore::kSky : RegionScore::kGround;
  if (surface == kTerrainSurface) return RegionScore::kGround;
  const SurfaceClass surface_class = model.surfaces[surface].surface_class;
  return surface_class == SurfaceClass::kGround || surface_class == SurfaceClass::kTerrain
             ? RegionScore::kGround
             : RegionScore::kBuilding;
}

}  // namespace

void RegionScoreOptions::Validate() const {
  if (columns >= 8 && columns <= 640) return;
  throw InputError("", "score.regions.columns", std::to_string(columns), "[8, 640]");
}

RegionScore::RegionScore(const cv::Mat& bgr,
                         const PinholeCamera& camera,
                         const CityModel& model,
                         const RegionScoreOptions& options)
    : camera_(camera.Scaled(static_cast<double>(options.columns) / camera.width)), model_(model) {
  cv::Mat cells;
  cv::resize(bgr, cells, cv::Size(camera_.width, camera_.height), 0.0, 0.0, cv::INTER_AREA);
  std::vector<float> luma;
  std::vector<float> blue;   // against red
  std::vector<float> green;  // against both
  for (int y = 0; y < cells.rows; ++y) {
    for (int x = 0; x < cells.cols; ++x) {
      const cv::Vec3b& c = cells.at<cv::Vec3b>(y, x);
      luma.push_back(0.114f * c[0] + 0.587f * c[1] + 0.299f * c[2]);
      // Shares of the colour, which brightness does not change.
      const float sum = static_cast<float>(c[0] + c[1] + c[2]) + 1.0f;
      blue.push_back((static_cast<float>(c[0]) - c[2]) / sum);
      green.push_back((2.0f * c[1] - c[0] - c[2]) / sum);
      rays_.push_back(
          camera_.RayFromImage({x + 0.5, y + 0.5}).cast<float>().normalized());
    }
  }
  const std::vector<int> luma_bins = RankBins(luma, kLumaBins);
  const std::vector<int> blue_bins = RankBins(blue, kChromaBins);
  const std::vector<int> green_bins = RankBins(green, kChromaBins);
  for (std::size_t i = 0; i < luma.size(); ++i) {
    colours_.push_back(static_cast<std::uint8_t>(
        (luma_bins[i] * kChromaBins + blue_bins[i]) * kChromaBins + green_bins[i]));
  }
  has_colours_ = std::adjacent_find(colours_.begin(), colours_.end(), std::not_equal_to<>()) !=
                 colours_.end();
}

double RegionScore::EnergyOfRegions(std::span<const std::uint8_t> regions) const {
  if (!has_colours_) return 1.0;
  std::array<std::array<int, kColours>, kRegions> counts{};
  std::array<int, kRegions> of_region{};
  std::array<int, kColours> of_colour{};
  int total = 0;
  for (std::size_t cell = 0; cell < colours_.size(); ++cell) {
    const std::uint8_t r = regions[cell];
    if (r == kRegions) continue;
    ++counts[r][colours_[cell]];
    ++of_region[r];
    ++of_colour[colours_[cell]];
    ++total;
  }
  // Without a building in view the sky and the ground alone would agree with any meadow.
  if (of_region[kBuilding] == 0 || of_region[kBuilding] == total) return 1.0;
  double information = 0.0;
  int joint_bins = 0;
  for (int r = 0; r < kRegions; ++r) {
    for (int c = 0; c < kColours; ++c) {
      const double n = counts[r][c];
      if (n == 0.0) continue;
      ++joint_bins;
      information += n * std::log(n * total / (static_cast<double>(of_region[r]) * of_colour[c]));
    }
  }
  const auto used = [](const auto& bins) {
    return static_cast<int>(std::count_if(bins.begin(), bins.end(), [](int n) { return n > 0; }));
  };
  const double chance = 0.5 * (joint_bins - used(of_region) - used(of_colour) + 1);
  return 1.0 - std::clamp((information - chance) / total / std::log(3.0), 0.0, 1.0);
}

double RegionScore::LogRatio(const PositionView& view,
                             const Pose& cam_from_local,
                             PictureEvidence::Workspace& workspace) const {
  const Eigen::Matrix3f local_from_cam =
      cam_from_local.cam_from_world.conjugate().toRotationMatrix().cast<float>();
  workspace.labels.resize(rays_.size());
  for (std::size_t cell = 0; cell < rays_.size(); ++cell) {
    const Eigen::Vector3f direction = local_from_cam * rays_[cell];
    const std::uint32_t* surface = view.surfaces.Find(direction);
    workspace.labels[cell] =
        surface == nullptr ? kRegions : RegionOf(*surface, direction.z() > 0.0f, model_);
  }
  return LogRatioOf(EnergyOfRegions(workspace.labels));
}

}  // namespace ridgeline
