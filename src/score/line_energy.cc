// SPDX-License-Identifier: Apache-2.0
#include "score/line_energy.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace ridgeline {
namespace {

constexpr float kPi = std::numbers::pi_v<float>;

float UndirectedAngle(const Eigen::Vector2f& d) {
  const float angle = std::atan2(d.y(), d.x());
  const float wrapped = angle < 0.0f ? angle + kPi : angle;
  return wrapped < kPi ? wrapped : 0.0f;
}

}  // namespace

LineEnergy::LineEnergy(std::span<const LineSegment> picture,
                       int width_px,
                       const LineEnergyOptions& options)
    : max_angle_rad_(static_cast<float>(options.max_angle_deg) * kPi / 180.0f),
      max_distance_px_(static_cast<float>(options.DistanceLimitPx(width_px))) {
  segments_.reserve(picture.size());
  for (std::size_t i = 0; i < picture.size(); ++i) {
    const LineSegment& segment = picture[i];
    segments_.push_back({0.5f * (segment.a + segment.b),
                         UndirectedAngle(segment.b - segment.a),
                         static_cast<std::uint32_t>(i)});
  }
  std::stable_sort(segments_.begin(), segments_.end(), [](const Directed& x, const Directed& y) {
    return x.angle < y.angle;
  });
}

template <typename Visit>
void LineEnergy::ForCorrespondents(const LineSegment& segment, const Visit& visit) const {
  const Eigen::Vector2f along = (segment.b - segment.a).normalized();
  const float angle = UndirectedAngle(along);
  // Angles wrap at pi: the window is looked at in three copies of the circle.
  for (const float shift : {-kPi, 0.0f, kPi}) {
    const float lowest = angle + shift - max_angle_rad_;
    auto it = std::lower_bound(segments_.begin(),
                               segments_.end(),
                               lowest,
                               [](const Directed& s, float value) { return s.angle < value; });
    for (; it != segments_.end() && it->angle <= angle + shift + max_angle_rad_; ++it) {
      const Eigen::Vector2f offset = it->middle - segment.a;
      const float distance = std::abs(along.x() * offset.y() - along.y() * offset.x());
      if (distance > max_distance_px_) continue;
      visit(*it, 1.0 - distance / max_distance_px_);
    }
  }
}

double LineEnergy::Energy(std::span<const LineSegment> model) const {
  if (model.empty()) return 1.0;
  double sum = 0.0;
  for (const LineSegment& segment : model) {
    double scores = 0.0;
    int count = 0;
    ForCorrespondents(segment, [&](const Directed&, double score) {
      scores += score;
      ++count;
    });
    if (count > 0) sum += scores / count;
  }
  return 1.0 - sum / static_cast<double>(model.size());
}

std::vector<LineEnergy::Pair> LineEnergy::Pairs(std::span<const LineSegment> model) const {
  std::vector<Pair> pairs;
  for (std::size_t j = 0; j < model.size(); ++j) {
    ForCorrespondents(model[j], [&](const Directed& picture, double score) {
      pairs.push_back({picture.index, j, score});
    });
  }
  return pairs;
}

}  // namespace ridgeline
