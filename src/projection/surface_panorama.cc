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

// Angle of the vectors (x, y) from the x axis, x and y >= 0.
Float4 FirstQuadrantAngle(Float4 x, Float4 y) {
  constexpr float kTiny = 1e-30f;
  const Float4 angle =
      FastAtanUpToOne(simd::Min(x, y) / simd::Max(simd::Max(x, y), simd::Splat(kTiny)));
  return y > x ? 0.5f * kPi - angle : angle;
}

// Cell of a grid whose first cell is centred on `first`; -1 before it.
Int4 CellOf(Float4 angle, float first, float inverse_step) {
  const Float4 place = (angle - first) * inverse_step + 0.5f;
  return place < 0.0f ? Int4{-1, -1, -1, -1} : __builtin_convertvector(place, Int4);
}

}  // namespace

Int4 SurfacePanorama::Find(const simd::Vec3x4& directions) const {
  const auto& [east, north, height] = directions;
  const auto inverse_step = static_cast<float>(1.0 / step);
  Float4 azimuth = FirstQuadrantAngle(simd::Abs(north), simd::Abs(east));
  azimuth = north < 0.0f ? kPi - azimuth : azimuth;
  azimuth = east < 0.0f ? -azimuth : azimuth;
  const auto first = static_cast<float>(first_azimuth);
  azimuth = azimuth < first - static_cast<float>(0.5 * step) ? azimuth + 2.0f * kPi : azimuth;
  const Float4 rise =
      FirstQuadrantAngle(simd::Sqrt(east * east + north * north), simd::Abs(height));
  const Int4 column = CellOf(azimuth, first, inverse_step);
  const Int4 row =
      CellOf(height < 0.0f ? -rise : rise, static_cast<float>(first_elevation), inverse_step);
  const Int4 inside = (column >= 0) & (column < columns) & (row >= 0) & (row < rows);
  return inside ? row * columns + column : Int4{-1, -1, -1, -1};
}

const std::uint32_t* SurfacePanorama::Find(const Eigen::Vector3f& direction) const {
  const std::int32_t cell = Find(simd::Splat(direction))[0];
  return cell < 0 ? nullptr : &surfaces[static_cast<std::size_t>(cell)];
}

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
  std::vector<Eigen::Vector2f> horizontal;  // per column
  horizontal.reserve(static_cast<std::size_t>(panorama.columns));
  for (int column = 0; column < panorama.columns; ++column) {
    const double azimuth = panorama.first_azimuth + column * panorama.step;
    horizontal.emplace_back(std::sin(azimuth), std::cos(azimuth));
  }
  std::vector<Eigen::Vector3f> directions;
  directions.reserve(static_cast<std::size_t>(panorama.columns) * panorama.rows);
  for (int row = 0; row < panorama.rows; ++row) {
    const double elevation = panorama.first_elevation + row * panorama.step;
    const auto cosine = static_cast<float>(std::cos(elevation));
    const auto sine = static_cast<float>(std::sin(elevation));
    for (const Eigen::Vector2f& h : horizontal) {
      directions.emplace_back(cosine * h.x(), cosine * h.y(), sine);
    }
  }
  panorama.surfaces = scene.SurfacesAlong(position, directions);
  return panorama;
}

}  // namespace ridgeline
