// SPDX-License-Identifier: Apache-2.0
#include "localize/gravity.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace ridgeline {
namespace {

constexpr float kPi = std::numbers::pi_v<float>;
constexpr double kStepDeg = 0.25;
// Of the first look; lines within a degree support a tilt (kSigmaRad).
constexpr double kCoarseDeg = 1.0;
constexpr float kVerticalShare = 0.3f;  // of the lines
constexpr float kSigmaRad = 1.0f * kPi / 180.0f;

struct Line {
  Eigen::Vector3f ray;
  Eigen::Vector2f direction;
  float weight;
};

std::vector<Line> LinesOf(std::span<const LineSegment> segments, const PinholeCamera& camera) {
  std::vector<Line> lines;
  for (const LineSegment& segment : segments) {
    const Eigen::Vector2d middle = (0.5f * (segment.a + segment.b)).cast<double>();
    lines.push_back({camera.RayFromImage(middle).cast<float>(),
                     (segment.b - segment.a).normalized(),
                     segment.Length() / static_cast<float>(camera.width)});
  }
  return lines;
}

double LogRatio(const std::vector<Line>& lines, const ViewAngles& tilt) {
  const Eigen::Vector3f down =
      (CamFromWorld(tilt) * Eigen::Vector3d(0.0, 0.0, -1.0)).cast<float>();
  const float peak = std::sqrt(2.0f / kPi) / kSigmaRad;
  constexpr float kBackground = 2.0f / kPi;  // undirected difference, uniform in [0, pi / 2]
  double sum = 0.0;
  for (const Line& line : lines) {
    const Eigen::Vector2f d(down.x() - line.ray.x() * down.z(), down.y() - line.ray.y() * down.z());
    const float norm = d.norm();
    if (norm <= 0.0f) continue;
    const float z =
        (d.x() * line.direction.y() - d.y() * line.direction.x()) / (norm * kSigmaRad);
    sum += line.weight * std::log(1.0f - kVerticalShare +
                                  kVerticalShare * peak * std::exp(-0.5f * z * z) / kBackground);
  }
  return sum;
}

struct TiltBox {
  ViewAngles center;
  double pitch_deg = 0.0;  // half-ranges
  double roll_deg = 0.0;
};
struct TiltGrid {
  double reach_deg = 0.0;
  double step_deg = 0.0;
};

// Of a grid around a tilt, those in the box. A parameter with a half-range of 0 stays.
std::vector<Tilt> TiltsAround(const std::vector<Line>& lines,
                              const TiltBox& box,
                              const ViewAngles& middle,
                              const TiltGrid& grid) {
  const auto values = [&](double center, double half_range, double at) {
    std::vector<double> result;
    if (half_range <= 0.0) return std::vector<double>{center};
    const double first = std::max(center - half_range, at - grid.reach_deg);
    const double last = std::min(center + half_range, at + grid.reach_deg);
    const int steps = std::max(1, static_cast<int>(std::ceil((last - first) / grid.step_deg)));
    for (int i = 0; i <= steps; ++i) result.push_back(first + (last - first) * i / steps);
    return result;
  };
  std::vector<Tilt> tilts;
  for (const double pitch : values(box.center.pitch_deg, box.pitch_deg, middle.pitch_deg)) {
    for (const double roll : values(box.center.roll_deg, box.roll_deg, middle.roll_deg)) {
      tilts.push_back({pitch, roll, LogRatio(lines, {0.0, pitch, roll})});
    }
  }
  return tilts;
}

// The best ones that are at least `separation_deg` apart, best first, at most `count`.
std::vector<Tilt> Apart(std::vector<Tilt> tilts, double separation_deg, int count) {
  std::stable_sort(tilts.begin(), tilts.end(), [](const Tilt& x, const Tilt& y) {
    return x.log_ratio > y.log_ratio;
  });
  std::vector<Tilt> chosen;
  for (const Tilt& tilt : tilts) {
    if (static_cast<int>(chosen.size()) == count) break;
    const bool is_near = std::any_of(chosen.begin(), chosen.end(), [&](const Tilt& other) {
      return std::hypot(tilt.pitch_deg - other.pitch_deg, tilt.roll_deg - other.roll_deg) <
             separation_deg;
    });
    if (!is_near) chosen.push_back(tilt);
  }
  return chosen;
}

}  // namespace

std::vector<Tilt> FindTilts(std::span<const LineSegment> segments,
                            const PinholeCamera& camera,
                            const ViewAngles& center,
                            double pitch_half_range_deg,
                            double roll_half_range_deg,
                            double separation_deg,
                            int count) {
  const std::vector<Line> lines = LinesOf(segments, camera);
  const bool searched = (pitch_half_range_deg > 0.0 || roll_half_range_deg > 0.0) && !lines.empty();
  if (!searched) return {{center.pitch_deg, center.roll_deg, 0.0}};
  std::vector<Tilt> tilts = TiltsAround(
      lines, {center, pitch_half_range_deg, roll_half_range_deg}, center, {180.0, kCoarseDeg});
  // The best of the coarse ones, closely.
  std::vector<Tilt> close;
  for (const Tilt& tilt : Apart(std::move(tilts), 2.0 * kCoarseDeg, 4 * count)) {
    const std::vector<Tilt> around =
        TiltsAround(lines,
                    {center, pitch_half_range_deg, roll_half_range_deg},
                    {0.0, tilt.pitch_deg, tilt.roll_deg},
                    {kCoarseDeg, kStepDeg});
    close.insert(close.end(), around.begin(), around.end());
  }
  return Apart(std::move(close), separation_deg, count);
}

}  // namespace ridgeline
