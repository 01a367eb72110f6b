// SPDX-License-Identifier: Apache-2.0
#include "skyline/clean_skyline.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

namespace ridgeline {
namespace {

double DistanceToSegment(const Eigen::Vector2d& p,
                         const Eigen::Vector2d& a,
                         const Eigen::Vector2d& b) {
  const Eigen::Vector2d d = b - a;
  const double length = d.squaredNorm();
  const double t = length > 0.0 ? std::clamp((p - a).dot(d) / length, 0.0, 1.0) : 0.0;
  return (p - a - t * d).norm();
}

// y of a polyline that goes from left to right, at x.
double HeightOn(const Polyline& line, double x, std::size_t& segment) {
  while (segment + 2 < line.size() && line[segment + 1].x() < x) ++segment;
  const Eigen::Vector2d& a = line[segment];
  const Eigen::Vector2d& b = line[segment + 1];
  return a.y() + (b.y() - a.y()) * (x - a.x()) / (b.x() - a.x());
}

}  // namespace

Polyline RemoveAberrantPoints(const Polyline& points, double precision_px) {
  if (precision_px <= 0.0 || points.size() < 3) return points;
  Polyline kept{points.front()};
  for (std::size_t i = 1; i + 1 < points.size(); ++i) {
    const double bend = points[i + 1].y() + points[i - 1].y() - 2.0 * points[i].y();
    if (std::abs(bend) < precision_px) kept.push_back(points[i]);
  }
  kept.push_back(points.back());
  return kept;
}

Polyline SimplifyPolyline(const Polyline& points, double precision_px) {
  if (precision_px <= 0.0 || points.size() < 3) return points;
  std::vector<bool> keep(points.size(), false);
  keep.front() = keep.back() = true;
  std::vector<std::pair<std::size_t, std::size_t>> open{{0, points.size() - 1}};
  while (!open.empty()) {
    const auto [first, last] = open.back();
    open.pop_back();
    double farthest = precision_px;
    std::size_t at = first;
    for (std::size_t i = first + 1; i < last; ++i) {
      const double d = DistanceToSegment(points[i], points[first], points[last]);
      if (d <= farthest) continue;
      farthest = d;
      at = i;
    }
    if (at == first) continue;
    keep[at] = true;
    open.emplace_back(first, at);
    open.emplace_back(at, last);
  }
  Polyline kept;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (keep[i]) kept.push_back(points[i]);
  }
  return kept;
}

Skyline CleanSkyline(const Skyline& skyline, double precision_px) {
  Skyline clean = skyline;
  for (std::size_t first = 0; first < skyline.size();) {
    std::size_t end = first;
    Polyline run;
    while (end < skyline.size() && skyline.columns[end] == SkylineColumn::kSeen) {
      run.emplace_back(skyline.XOf(end), skyline.y_px[end]);
      ++end;
    }
    if (run.size() >= 3) {
      const Polyline line = SimplifyPolyline(RemoveAberrantPoints(run, precision_px), precision_px);
      std::size_t segment = 0;
      for (std::size_t c = first; c < end; ++c) {
        clean.y_px[c] = static_cast<float>(HeightOn(line, skyline.XOf(c), segment));
      }
    }
    first = std::max(end, first + 1);
  }
  return clean;
}

}  // namespace ridgeline
