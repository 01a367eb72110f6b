// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <array>
#include <span>
#include <vector>

#include "base/options.h"
#include "camera/intrinsics.h"
#include "city/city_model.h"
#include "lines/line_segment.h"
#include "projection/simd4.h"
#include "projection/surface_panorama.h"
#include "score/surface_groups.h"

namespace ridgeline {

struct FacadeDirectionOptions {
  // Share of the lines on a wall that run along its courses or its corners.
  double aligned_share = 0.6;
  // Standard deviation of their directions in the picture [deg].
  double sigma_deg = 2.0;
  // Lines used, the longest first.
  int max_lines = 1000;

  void Visit(OptionVisitor& v) {
    v.Field("aligned_share", aligned_share, Open(0.0, 1.0));
    v.Field("sigma_deg", sigma_deg, Positive());
    v.Field("max_lines", max_lines, AtLeast(1));
  }
};

// Explains the picture's lines by the surfaces that a pose puts behind them: windows, cornices and
// joints of a wall run horizontally in its plane or vertically. Log likelihood ratio of the lines'
// directions on model surfaces against the picture's own distribution of directions, weighted by
// length. Needs no modelled edge near a line.
class FacadeDirections {
 public:
  FacadeDirections(std::span<const LineSegment> segments,
                   const PinholeCamera& camera,
                   const FacadeDirectionOptions& options);

  // Weight 1 is a line as long as the picture is wide.
  float LogRatio(const SurfacePanorama& surfaces,
                 const CityModel& model,
                 const Eigen::Matrix3f& cam_from_world) const;

  // Four lines side by side.
  struct Lines {
    simd::Vec3x4 ray;  // through the middle, camera axes, z = 1
    simd::Float4 dx, dy;
    simd::Float4 weight;
    std::array<std::size_t, 4> table;  // first entry of the direction's row in log_ratios_
  };
  // Of the last four some may be missing: their weights are 0.
  const std::vector<Lines>& lines() const { return lines_; }

  // Log ratios of four lines, weighted, on surfaces with these directions [camera axes, any length].
  simd::Float4 LogRatios(const Lines& lines,
                         const simd::Vec3x4& course,
                         const simd::Vec3x4& rise) const;

 private:
  static simd::Float4 SquareOfSine(const Lines& lines, const simd::Vec3x4& direction);
  // Log likelihood ratio of a line whose direction is off by sqrt(square) standard deviations.
  float LogRatioAt(std::size_t table, float square) const;

  std::vector<Lines> lines_;
  float inverse_variance_;         // of sines [1 / rad^2]
  std::vector<float> log_ratios_;  // by direction of the picture, then by square of the deviation
};

}  // namespace ridgeline
