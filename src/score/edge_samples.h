// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <span>

#include "projection/scene.h"
#include "score/oriented_distance_field.h"

namespace ridgeline {

// Mean over samples along projected edges, each weighted by the length it stands for, so that the
// number of pieces an edge is cut into does not matter. Calls value(direction bin, x, y) with pixels
// inside the image width x height. Negative without any length to look at.
template <typename Value>
double MeanAlongEdges(std::span<const ProjectedSegment> segments,
                      float spacing_px,
                      int width,
                      int height,
                      const Value& value) {
  double sum = 0.0;
  double total = 0.0;
  const float max_x = static_cast<float>(width) - 1.0f;
  const float max_y = static_cast<float>(height) - 1.0f;
  for (const ProjectedSegment& segment : segments) {
    const Eigen::Vector2f d = segment.b - segment.a;
    const float length = d.norm();
    const int samples = std::max(1, static_cast<int>(length / spacing_px + 0.5f));
    const int direction = OrientedDistanceField::DirectionOf(d.x(), d.y());
    double partial = 0.0;
    for (int i = 0; i < samples; ++i) {
      const float t = (static_cast<float>(i) + 0.5f) / static_cast<float>(samples);
      const int x = static_cast<int>(std::clamp(segment.a.x() + t * d.x(), 0.0f, max_x));
      const int y = static_cast<int>(std::clamp(segment.a.y() + t * d.y(), 0.0f, max_y));
      partial += value(direction, x, y);
    }
    sum += partial * length / samples;
    total += length;
  }
  return total > 0.0 ? sum / total : -1.0;
}

}  // namespace ridgeline
