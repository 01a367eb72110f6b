// SPDX-License-Identifier: Apache-2.0
#include "score/region_information.h"

#include <algorithm>
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

RegionInformation::Region RegionOf(std::uint32_t surface, bool is_upward, const CityModel& model) {
  // Beyond the model and the terrain the ground goes on to the horizon.
  if (surface == kNoSurface)
    return is_upward ? RegionInformation::kSky : RegionInformation::kGround;
  if (surface == kTerrainSurface) return RegionInformation::kGround;
  const SurfaceClass surface_class = model.surfaces[surface].surface_class;
  return surface_class == SurfaceClass::kGround || surface_class == SurfaceClass::kTerrain
             ? RegionInformation::kGround
             : RegionInformation::kBuilding;
}

}  // namespace

void RegionOptions::Validate() const {
  if (columns >= 8 && columns <= 640) return;
  throw InputError("", "score.regions.columns", std::to_string(columns), "[8, 640]");
}

RegionInformation::RegionInformation(const cv::Mat& bgr,
                                     const PinholeCamera& camera,
                                     const RegionOptions& options)
    : camera_(camera.Scaled(static_cast<double>(options.columns) / camera.width)) {
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
      const std::size_t cell = luma.size() - 1;
      if (cell % 4 == 0) rays_.push_back(simd::Splat(Eigen::Vector3f(0.0f, 0.0f, 1.0f)));
      simd::SetLane(rays_.back(),
                    static_cast<int>(cell % 4),
                    camera_.RayFromImage({x + 0.5, y + 0.5}).cast<float>());
    }
  }
  const std::vector<int> luma_bins = RankBins(luma, kLumaBins);
  const std::vector<int> blue_bins = RankBins(blue, kChromaBins);
  const std::vector<int> green_bins = RankBins(green, kChromaBins);
  for (std::size_t i = 0; i < luma.size(); ++i) {
    colours_.push_back(static_cast<std::uint8_t>(
        (luma_bins[i] * kChromaBins + blue_bins[i]) * kChromaBins + green_bins[i]));
  }
  has_colours_ =
      std::adjacent_find(colours_.begin(), colours_.end(), std::not_equal_to<>()) != colours_.end();
}

double RegionInformation::Share(std::span<const std::uint8_t> regions) const {
  if (!has_colours_) return 0.0;
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
  if (of_region[kBuilding] == 0 || of_region[kBuilding] == total) return 0.0;
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
  return std::clamp((information - chance) / total / std::log(3.0), 0.0, 1.0);
}

double RegionInformation::Share(const SurfacePanorama& surfaces,
                                const CityModel& model,
                                const Eigen::Matrix3f& cam_from_world,
                                std::vector<std::uint8_t>& labels) const {
  const Eigen::Matrix3f world_from_cam = cam_from_world.transpose();
  const simd::Vec3x4 rows[3] = {simd::Splat(world_from_cam.row(0)),
                                simd::Splat(world_from_cam.row(1)),
                                simd::Splat(world_from_cam.row(2))};
  labels.assign(4 * rays_.size(), kRegions);
  for (std::size_t i = 0; i < rays_.size(); ++i) {
    const simd::Vec3x4 directions = {
        simd::Dot(rows[0], rays_[i]), simd::Dot(rows[1], rays_[i]), simd::Dot(rows[2], rays_[i])};
    const simd::Int4 cells = surfaces.Find(directions);
    for (int lane = 0; lane < 4; ++lane) {
      if (cells[lane] < 0) continue;
      labels[4 * i + static_cast<std::size_t>(lane)] =
          RegionOf(surfaces.surfaces[static_cast<std::size_t>(cells[lane])],
                   directions.z[lane] > 0.0f,
                   model);
    }
  }
  return Share(labels);
}

}  // namespace ridgeline
