// SPDX-License-Identifier: Apache-2.0
#include "projection/surface_panorama.h"

#include <algorithm>
#include <numbers>

#include "projection/fast_angle.h"

namespace ridgeline {

namespace {

using simd::Float4;
using simd::Int4;

constexpr float kPi = std::numbers::pi_v<float>;
// Spacing of the first rays, in cells; a power of two.
constexpr int kCoarsest = 4;

}  // namespace

SurfacePanorama::Places SurfacePanorama::PlacesOf(const simd::Vec3x4& directions) const {
  const auto& [east, north, height] = directions;
  const auto inverse_step = static_cast<float>(1.0 / step);
  Float4 azimuth = FastAngleFromAxis(simd::Abs(north), simd::Abs(east));
  azimuth = north < 0.0f ? kPi - azimuth : azimuth;
  azimuth = east < 0.0f ? -azimuth : azimuth;
  const auto first = static_cast<float>(first_azimuth);
  azimuth = azimuth < first - static_cast<float>(0.5 * step) ? azimuth + 2.0f * kPi : azimuth;
  const Float4 rise = FastAngleFromAxis(simd::Sqrt(east * east + north * north), simd::Abs(height));
  const Float4 elevation = height < 0.0f ? -rise : rise;
  return {(azimuth - first) * inverse_step + 0.5f,
          (elevation - static_cast<float>(first_elevation)) * inverse_step + 0.5f};
}

const std::uint32_t* SurfacePanorama::Find(const Eigen::Vector3f& direction) const {
  const std::int32_t cell = Find(simd::Splat(direction))[0];
  return cell < 0 ? nullptr : &surfaces[static_cast<std::size_t>(cell)];
}

namespace {

// Casts rays through chosen cells of a panorama.
class GridCaster {
 public:
  GridCaster(const Scene& scene, const Eigen::Vector3d& position, SurfacePanorama& panorama)
      : scene_(scene), position_(position), panorama_(panorama) {
    for (int column = 0; column < panorama.columns; ++column) {
      const double azimuth = panorama.first_azimuth + column * panorama.step;
      horizontal_.emplace_back(std::sin(azimuth), std::cos(azimuth));
    }
    for (int row = 0; row < panorama.rows; ++row) {
      const double elevation = panorama.first_elevation + row * panorama.step;
      vertical_.emplace_back(std::cos(elevation), std::sin(elevation));
    }
  }

  void Want(int row, int column) {
    const Eigen::Vector2f& v = vertical_[static_cast<std::size_t>(row)];
    const Eigen::Vector2f& h = horizontal_[static_cast<std::size_t>(column)];
    directions_.emplace_back(v.x() * h.x(), v.x() * h.y(), v.y());
    cells_.push_back(static_cast<std::size_t>(row) * panorama_.columns + column);
  }

  void Cast() {
    const std::vector<std::uint32_t> seen = scene_.SurfacesAlong(position_, directions_);
    for (std::size_t i = 0; i < seen.size(); ++i) panorama_.surfaces[cells_[i]] = seen[i];
    directions_.clear();
    cells_.clear();
  }

 private:
  const Scene& scene_;
  Eigen::Vector3d position_;
  SurfacePanorama& panorama_;
  std::vector<Eigen::Vector2f> horizontal_;  // sine and cosine of the azimuth, by column
  std::vector<Eigen::Vector2f> vertical_;    // cosine and sine of the elevation, by row
  std::vector<Eigen::Vector3f> directions_;
  std::vector<std::size_t> cells_;
};

// Fills the grid of half the spacing `block`, of which every second row and column is known: from
// the corners of a block where they see the same, else by rays.
void Halve(int block, SurfacePanorama& panorama, GridCaster& caster) {
  const int half = block / 2;
  const auto at = [&](int row, int column) -> std::uint32_t& {
    return panorama.surfaces[static_cast<std::size_t>(row) * panorama.columns + column];
  };
  const int blocks_across = (panorama.columns - 1) / block;
  // Whether the corners differ, by block of a row of them; none do outside the grid.
  const auto differ_in = [&](int row) {
    std::vector<char> differ(static_cast<std::size_t>(blocks_across) + 2, 0);
    if (row < 0 || row + block >= panorama.rows) return differ;
    for (int i = 0; i < blocks_across; ++i) {
      const std::uint32_t corner = at(row, i * block);
      differ[i + 1] = corner != at(row, (i + 1) * block) || corner != at(row + block, i * block) ||
                      corner != at(row + block, (i + 1) * block);
    }
    return differ;
  };
  std::vector<char> above = differ_in(-block);
  for (int row = 0; row < panorama.rows; row += block) {
    const std::vector<char> below = differ_in(row);
    const bool has_below = row + block < panorama.rows;
    for (int i = 0; i <= blocks_across; ++i) {
      const int column = i * block;
      const auto set = [&](int r, int c, bool cast) {
        if (cast) {
          caster.Want(r, c);
        } else {
          at(r, c) = at(row, column);
        }
      };
      // Blocks are numbered from 1: block i + 1 is to the right of this corner.
      if (i < blocks_across) set(row, column + half, above[i + 1] || below[i + 1]);
      if (has_below) set(row + half, column, below[i] || below[i + 1]);
      if (i < blocks_across && has_below) set(row + half, column + half, below[i + 1]);
    }
    above = below;
  }
  caster.Cast();
}

}  // namespace

SurfacePanorama SurfacesFrom(const Scene& scene,
                             const Eigen::Vector3d& position,
                             const PanoramaRange& range) {
  SurfacePanorama panorama;
  const double half_width = std::min(range.sector.half_width, std::numbers::pi);
  panorama.step = range.step;
  // In (-pi, pi], so that Find needs one turn at most.
  panorama.first_azimuth = std::remainder(range.sector.center - half_width, 2.0 * std::numbers::pi);
  panorama.first_elevation = range.sector.lowest_elevation;
  panorama.columns = static_cast<int>(std::ceil(2.0 * half_width / range.step)) + 1;
  panorama.rows =
      std::max(1,
               static_cast<int>(std::ceil(
                   (range.sector.highest_elevation - range.sector.lowest_elevation) / range.step)) +
                   1);
  // Whole blocks of the coarsest grid.
  const auto up_to_block = [](int cells) {
    return (cells - 1 + kCoarsest - 1) / kCoarsest * kCoarsest + 1;
  };
  panorama.columns = up_to_block(panorama.columns);
  panorama.rows = up_to_block(panorama.rows);
  panorama.surfaces.assign(static_cast<std::size_t>(panorama.columns) * panorama.rows, kNoSurface);
  GridCaster caster(scene, position, panorama);
  for (int row = 0; row < panorama.rows; row += kCoarsest) {
    for (int column = 0; column < panorama.columns; column += kCoarsest) caster.Want(row, column);
  }
  caster.Cast();
  for (int block = kCoarsest; block > 1; block /= 2) Halve(block, panorama, caster);
  return panorama;
}

}  // namespace ridgeline
