// SPDX-License-Identifier: Apache-2.0
#include "score/facade_table.h"

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>
#include <utility>

namespace ridgeline {
namespace {

using Lines = FacadeDirections::Lines;

std::vector<Eigen::Vector3f> RaysOf(std::span<const Lines> lines) {
  std::vector<Eigen::Vector3f> rays;
  for (const Lines& four : lines) {
    for (int k = 0; k < 4; ++k) rays.emplace_back(four.ray.x[k], four.ray.y[k], four.ray.z[k]);
  }
  return rays;
}

std::vector<float> TableOf(const FacadeDirections& directions,
                           const Eigen::Matrix3f& cam_from_level) {
  std::vector<float> table;
  table.reserve(4 * directions.lines().size() * kCourses);
  const simd::Vec3x4 up = simd::Splat(cam_from_level.col(2));
  for (int i = 0; i < kCourses; ++i) {
    const double azimuth = i * std::numbers::pi / kCourses;
    const Eigen::Vector3f course(
        static_cast<float>(std::sin(azimuth)), static_cast<float>(std::cos(azimuth)), 0.0f);
    const simd::Vec3x4 in_camera = simd::Splat(cam_from_level * course);
    for (const Lines& lines : directions.lines()) {
      const simd::Float4 ratios = directions.LogRatios(lines, in_camera, up);
      for (int k = 0; k < 4; ++k) table.push_back(ratios[k]);
    }
  }
  return table;
}

}  // namespace

FacadeTable::FacadeTable(std::shared_ptr<const FacadeDirections> directions,
                         std::span<const Eigen::Matrix3f> cam_from_level)
    : directions_(std::move(directions)),
      rays_(RaysOf(directions_->lines()), cam_from_level),
      columns_(4 * directions_->lines().size()) {
  for (const Eigen::Matrix3f& tilt : cam_from_level) tables_.push_back(TableOf(*directions_, tilt));
}

float FacadeTable::LogRatio(const PositionView& view,
                            const CityModel& model,
                            const Eigen::Matrix3f& cam_from_local,
                            const TiltedRays::Turned& turned) const {
  constexpr float kPerRad = kCourses * std::numbers::inv_pi_v<float>;
  const int heading = static_cast<int>(std::lround(turned.heading * kPerRad)) + 2 * kCourses;
  const int turn = heading % kCourses;
  const float* const table = tables_[turned.tilt].data();
  const std::uint16_t* const courses = view.groups.courses.data();
  float sums[4] = {};
  rays_.ForCells(view.surfaces, turned, [&](std::size_t i, const simd::Int4& cells) {
    for (std::size_t k = 0; k < 4; ++k) {
      if (cells[k] < 0) continue;
      const int course = courses[cells[k]];
      const std::size_t line = 4 * i + k;
      if (course < kCourses) {
        const int relative = course - turn;
        sums[k] += table[(relative < 0 ? relative + kCourses : relative) * columns_ + line];
      } else if (course == kSlopedCourse) {
        const std::uint32_t surface = view.surfaces.surfaces[static_cast<std::size_t>(cells[k])];
        sums[k] += OnSlope(line, model.surfaces[surface].normal, cam_from_local);
      }
    }
  });
  return (sums[0] + sums[1]) + (sums[2] + sums[3]);
}

float FacadeTable::OnSlope(std::size_t line,
                           const Eigen::Vector3f& normal,
                           const Eigen::Matrix3f& r) const {
  const Eigen::Vector3f along(-normal.y(), normal.x(), 0.0f);
  const simd::Float4 ratios = directions_->LogRatios(directions_->lines()[line / 4],
                                                     simd::Splat(r * along),
                                                     simd::Splat(r * normal.cross(along)));
  return ratios[line % 4];
}

}  // namespace ridgeline
