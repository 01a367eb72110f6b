// SPDX-License-Identifier: Apache-2.0
#include "score/colour_information.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <opencv2/imgproc.hpp>
#include <string>

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

// ln(a (a + 1) ... (a + n - 1)) for n up to `most`.
std::vector<double> LogRisingFactorials(double a, std::size_t most) {
  std::vector<double> result = {0.0};
  for (std::size_t n = 0; n < most; ++n) {
    result.push_back(result.back() + std::log(a + static_cast<double>(n)));
  }
  return result;
}

}  // namespace

ColourInformation::ColourInformation(const cv::Mat& bgr,
                                     const PinholeCamera& camera,
                                     const ColourOptions& options,
                                     const cv::Mat& hidden)
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
  if (!hidden.empty()) {
    cv::Mat hidden_cells;
    cv::resize(hidden, hidden_cells, cells.size(), 0.0, 0.0, cv::INTER_AREA);
    for (std::size_t i = 0; i < colours_.size(); ++i) {
      if (hidden_cells.ptr()[i] > 127) colours_[i] = kHidden;
    }
  }

  nodes_across_ = (camera_.width - 1) / kBlock + 2;
  nodes_down_ = (camera_.height - 1) / kBlock + 2;
  node_rays_.resize((static_cast<std::size_t>(nodes_across_) * nodes_down_ + 3) / 4,
                    simd::Splat(Eigen::Vector3f(0.0f, 0.0f, 1.0f)));
  std::size_t node = 0;
  for (int j = 0; j < nodes_down_; ++j) {
    for (int i = 0; i < nodes_across_; ++i, ++node) {
      simd::SetLane(node_rays_[node / 4],
                    static_cast<int>(node % 4),
                    camera_.RayFromImage({kBlock * i + 0.5, kBlock * j + 0.5}).cast<float>());
    }
  }

  // The concentration of a colour: few colours make up one facade.
  constexpr double kConcentration = 0.1;
  log_rising_colour_ = LogRisingFactorials(kConcentration, colours_.size());
  log_rising_all_ = LogRisingFactorials(kConcentration * kColours, colours_.size());
  for (std::size_t n = 0; n <= colours_.size(); ++n) {
    n_log_n_.push_back(n == 0 ? 0.0 : static_cast<double>(n) * std::log(static_cast<double>(n)));
  }
}

// Over the colours, in four sums side by side.
double ColourInformation::SumOfLogRising(const std::uint32_t* counts) const {
  std::array<double, 4> sums{};
  int c = 0;
  for (; c + 4 <= kColours; c += 4) {
    for (int k = 0; k < 4; ++k) sums[k] += log_rising_colour_[counts[c + k]];
  }
  for (; c < kColours; ++c) sums[0] += log_rising_colour_[counts[c]];
  return (sums[0] + sums[1]) + (sums[2] + sums[3]);
}

ColourInformation::Cues ColourInformation::Of(std::span<const std::uint16_t> groups,
                                              int group_count,
                                              Workspace& workspace) const {
  if (!has_colours_) return {};
  std::vector<std::uint32_t>& joint = workspace.joint;
  std::vector<std::uint8_t>& in_view = workspace.in_view;
  const auto count = static_cast<std::size_t>(group_count);
  if (in_view.size() <= count) {
    in_view.resize(count + 1, 0);
    joint.resize((count + 1) * kStride, 0);
  }
  // Cells without a group or a colour are counted in a row and a column of their own. Cells that
  // follow each other would wait for each other's counts: neighbours are four parts of the picture.
  const auto add = [count,
                    group_of_cell = groups.data(),
                    colour_of_cell = colours_.data(),
                    counts = joint.data(),
                    is_in_view = in_view.data()](std::size_t cell) {
    const std::size_t g = std::min<std::size_t>(group_of_cell[cell], count);
    ++counts[g * kStride + colour_of_cell[cell]];
    is_in_view[g] = 1;
  };
  const std::size_t part = colours_.size() / 4;
  for (std::size_t i = 0; i < part; ++i) {
    add(i);
    add(part + i);
    add(2 * part + i);
    add(3 * part + i);
  }
  for (std::size_t cell = 4 * part; cell < colours_.size(); ++cell) add(cell);

  enum { kSky, kBuilding, kGround, kRegions };
  std::array<std::array<std::uint32_t, kColours>, kRegions> of_region_and_colour{};
  std::array<std::uint32_t, kRegions> of_region{};
  double facades = 0.0;
  for (std::size_t g = 0; g <= count; ++g) {
    if (in_view[g] == 0) continue;
    in_view[g] = 0;
    std::uint32_t* const counts = &joint[g * kStride];
    if (g < count) {
      const int region = g == kSkyGroup ? kSky : g == kGroundGroup ? kGround : kBuilding;
      std::uint32_t of_group = 0;
      for (int c = 0; c < kColours; ++c) {
        of_group += counts[c];
        of_region_and_colour[region][c] += counts[c];
      }
      if (region == kBuilding) facades += SumOfLogRising(counts) - log_rising_all_[of_group];
      of_region[region] += of_group;
    }
    std::fill_n(counts, kStride, 0u);
  }
  facades += log_rising_all_[of_region[kBuilding]] -
             SumOfLogRising(of_region_and_colour[kBuilding].data());

  const std::uint32_t total = of_region[kSky] + of_region[kBuilding] + of_region[kGround];
  // Without a building in view the sky and the ground alone would agree with any meadow.
  if (of_region[kBuilding] == 0 || of_region[kBuilding] == total) return {0.0, facades};
  double information = n_log_n_[total];
  int joint_bins = 0;
  int colours = 0;
  for (int c = 0; c < kColours; ++c) {
    std::uint32_t of_colour = 0;
    for (int r = 0; r < kRegions; ++r) {
      const std::uint32_t n = of_region_and_colour[r][c];
      information += n_log_n_[n];
      joint_bins += n > 0 ? 1 : 0;
      of_colour += n;
    }
    information -= n_log_n_[of_colour];
    colours += of_colour > 0 ? 1 : 0;
  }
  int regions = 0;
  for (const std::uint32_t n : of_region) {
    information -= n_log_n_[n];
    regions += n > 0 ? 1 : 0;
  }
  const double chance = 0.5 * (joint_bins - regions - colours + 1);
  return {std::clamp((information - chance) / total / std::log(3.0), 0.0, 1.0), facades};
}

void ColourInformation::FindGroups(const SurfacePanorama& surfaces,
                                   const SurfaceGroups& groups,
                                   const Eigen::Matrix3f& cam_from_world,
                                   Workspace& workspace) const {
  const Eigen::Matrix3f world_from_cam = cam_from_world.transpose();
  const simd::Vec3x4 rows[3] = {simd::Splat(world_from_cam.row(0)),
                                simd::Splat(world_from_cam.row(1)),
                                simd::Splat(world_from_cam.row(2))};
  const auto in_world = [&](const simd::Vec3x4& rays) {
    return simd::Vec3x4{
        simd::Dot(rows[0], rays), simd::Dot(rows[1], rays), simd::Dot(rows[2], rays)};
  };
  workspace.nodes.resize(node_rays_.size());
  for (std::size_t i = 0; i < node_rays_.size(); ++i) {
    workspace.nodes[i] = surfaces.PlacesOf(in_world(node_rays_[i]));
  }
  const auto node = [&](int j, int i) {
    const std::size_t k = static_cast<std::size_t>(j) * nodes_across_ + i;
    const SurfacePanorama::Places& four = workspace.nodes[k / 4];
    return Eigen::Vector2f(four.column[k % 4], four.row[k % 4]);
  };
  workspace.groups.resize(colours_.size());
  // Where straight up or down, or the jump of the azimuth, is within a block.
  const auto limit = static_cast<float>(0.5 / surfaces.step);
  constexpr simd::Float4 kLanes = {0.0f, 1.0f / kBlock, 2.0f / kBlock, 3.0f / kBlock};
  static_assert(kBlock == 4, "a lane a cell");
  for (int j = 0; j + 1 < nodes_down_; ++j) {
    for (int i = 0; i + 1 < nodes_across_; ++i) {
      const Eigen::Vector2f a = node(j, i);
      const Eigen::Vector2f right = node(j, i + 1) - a;
      const Eigen::Vector2f down = node(j + 1, i) - a;
      const Eigen::Vector2f twist = node(j + 1, i + 1) - a - right - down;
      const bool is_smooth =
          std::abs(right.x()) < limit && std::abs(down.x()) < limit && std::abs(twist.x()) < limit;
      const int lanes = std::min(kBlock, camera_.width - kBlock * i);
      for (int s = 0; s < kBlock && kBlock * j + s < camera_.height; ++s) {
        simd::Int4 cells;
        if (is_smooth) {
          const float t = static_cast<float>(s) / kBlock;
          cells = surfaces.CellsAt({a.x() + t * down.x() + (right.x() + t * twist.x()) * kLanes,
                                    a.y() + t * down.y() + (right.y() + t * twist.y()) * kLanes});
        } else {
          simd::Vec3x4 rays = simd::Splat(Eigen::Vector3f(0.0f, 0.0f, 1.0f));
          for (int lane = 0; lane < kBlock; ++lane) {
            const Eigen::Vector2d pixel(kBlock * i + lane + 0.5, kBlock * j + s + 0.5);
            simd::SetLane(rays, lane, camera_.RayFromImage(pixel).cast<float>());
          }
          cells = surfaces.Find(in_world(rays));
        }
        std::uint16_t* out =
            &workspace
                 .groups[static_cast<std::size_t>(kBlock * j + s) * camera_.width + kBlock * i];
        for (int lane = 0; lane < lanes; ++lane) {
          out[lane] =
              cells[lane] < 0 ? kNoGroup : groups.of_cell[static_cast<std::size_t>(cells[lane])];
        }
      }
    }
  }
}

ColourInformation::Cues ColourInformation::Of(const SurfacePanorama& surfaces,
                                              const SurfaceGroups& groups,
                                              const Eigen::Matrix3f& cam_from_world,
                                              Workspace& workspace) const {
  if (!has_colours_) return {};
  FindGroups(surfaces, groups, cam_from_world, workspace);
  return Of(workspace.groups, groups.count, workspace);
}

ColourInformation::Cues ColourInformation::Of(const SurfacePanorama& surfaces,
                                              const SurfaceGroups& groups,
                                              const TiltedRays& rays,
                                              const TiltedRays::Turned& turned,
                                              Workspace& workspace) const {
  if (!has_colours_) return {};
  // Whole fours: the last may have copies of a ray.
  workspace.groups.resize((colours_.size() + 3) / 4 * 4);
  rays.ForCells(surfaces, turned, [&](std::size_t i, const simd::Int4& cells) {
    for (std::size_t k = 0; k < 4; ++k) {
      workspace.groups[4 * i + k] =
          cells[k] < 0 ? kNoGroup : groups.of_cell[static_cast<std::size_t>(cells[k])];
    }
  });
  return Of(workspace.groups, groups.count, workspace);
}

std::vector<Eigen::Vector3f> ColourInformation::cell_rays() const {
  std::vector<Eigen::Vector3f> rays;
  rays.reserve(colours_.size());
  for (int y = 0; y < camera_.height; ++y) {
    for (int x = 0; x < camera_.width; ++x) {
      rays.push_back(camera_.RayFromImage({x + 0.5, y + 0.5}).cast<float>());
    }
  }
  return rays;
}

}  // namespace ridgeline
