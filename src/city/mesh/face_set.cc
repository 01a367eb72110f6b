// SPDX-License-Identifier: Apache-2.0
#include "city/mesh/face_set.h"

#include <Eigen/Geometry>
#include <algorithm>

namespace ridgeline {

void FaceSet::Flip(Face& face) {
  for (std::uint32_t r = face.first_ring; r < face.first_ring + face.ring_count; ++r) {
    const auto begin = corners.begin() + static_cast<std::ptrdiff_t>(rings[r].first);
    std::reverse(begin, begin + static_cast<std::ptrdiff_t>(rings[r].count));
  }
  face.normal = -face.normal;
}

Eigen::Vector3d NewellNormal(const FaceSet& set, std::span<const std::uint32_t> ring) {
  // Relative to the first corner, so that large coordinates cancel before they are multiplied.
  const Eigen::Vector3d& first = set.vertices[ring.front()];
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
  for (std::size_t i = 1; i + 1 < ring.size(); ++i) {
    normal += (set.vertices[ring[i]] - first).cross(set.vertices[ring[i + 1]] - first);
  }
  return normal;
}

}  // namespace ridgeline
