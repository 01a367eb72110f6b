// SPDX-License-Identifier: Apache-2.0
#include "localize/gravity.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace ridgeline {
namespace {

constexpr float kPi = std::numbers::pi_v<float>;
constexpr double kStepDeg = 0.25;
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
  const int pitch_steps = static_cast<int>(std::ceil(pitch_half_range_deg / kStepDeg));
  const int roll_steps = static_cast<int>(std::ceil(roll_half_range_deg / kStepDeg));
  std::vector<Tilt> tilts;
  for (int p = -pitch_steps; p <= pitch_steps; ++p) {
    for (int r = -roll_steps; r <= roll_steps; ++r) {
      Tilt tilt;
      tilt.pitch_deg =
          center.pitch_deg + (p == 0 ? 0.0 : pitch_half_range_deg * p / pitch_steps);
      tilt.roll_deg = center.roll_deg + (r == 0 ? 0.0 : roll_half_range_deg * r / roll_steps);
      tilt.log_ratio = LogRatio(lines, {0.0, tilt.pitch_deg, tilt.roll_deg});
      tilts.push_back(tilt);
    }
  }
  std::stable_sort(tilts.begin(), tilts.end(),
                   [](const Tilt& x, const Tilt& y) { return x.log_ratio > y.log_ratio; });
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

}  // namespace ridgeline
