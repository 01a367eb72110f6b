// SPDX-License-Identifier: Apache-2.0
#include "score/sky_score.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace ridgeline {

void SkylineRows(std::span<const Eigen::Vector3f> directions,
                 const PinholeCamera& camera,
                 const Eigen::Matrix3f& cam_from_world,
                 std::span<float> rows) {
  constexpr float kMinZ = 0.05f;  // directions are unit vectors: nearly 90 degrees off the axis
  std::fill(rows.begin(), rows.end(), std::numeric_limits<float>::quiet_NaN());
  const float fx = static_cast<float>(camera.fx);
  const float fy = static_cast<float>(camera.fy);
  const float cx = static_cast<float>(camera.cx);
  const float cy = static_cast<float>(camera.cy);
  const int columns = static_cast<int>(rows.size());
  const float width = static_cast<float>(columns);
  bool has_last = false;
  float last_x = 0.0f;
  float last_y = 0.0f;
  for (const Eigen::Vector3f& direction : directions) {
    const Eigen::Vector3f p = cam_from_world * direction;
    if (p.z() < kMinZ) {
      has_last = false;
      continue;
    }
    const float inverse_z = 1.0f / p.z();
    const float x = fx * p.x() * inverse_z + cx;
    const float y = fy * p.y() * inverse_z + cy;
    if (has_last && x > last_x && x > 0.0f && last_x < width) {
      // Columns whose centres lie in (last_x, x].
      const int first = std::max(0, static_cast<int>(std::ceil(last_x - 0.5f)));
      const int last = std::min(columns - 1, static_cast<int>(std::floor(x - 0.5f)));
      for (int c = first; c <= last; ++c) {
        const float t = (static_cast<float>(c) + 0.5f - last_x) / (x - last_x);
        rows[c] = last_y + t * (y - last_y);
      }
    }
    has_last = true;
    last_x = x;
    last_y = y;
  }
}

double SkyLogRatio(const SkyTable& table, std::span<const float> rows) {
  double sum = 0.0;
  for (int c = 0; c < table.columns(); ++c) {
    if (!std::isnan(rows[c])) sum += table.LogRatio(c, rows[c]);
  }
  return sum / table.columns();
}

}  // namespace ridgeline
