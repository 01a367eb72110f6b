// SPDX-License-Identifier: Apache-2.0
#include "optim/places.h"

#include <algorithm>
#include <cmath>

namespace ridgeline {

bool Apart(const UnitPoint& a,
           const UnitPoint& b,
           const std::vector<bool>& periodic,
           double distance) {
  for (std::size_t k = 0; k < a.size(); ++k) {
    const double way = std::abs(a[k] - b[k]);
    if ((periodic[k] ? std::min(way, 1.0 - way) : way) > distance) return true;
  }
  return false;
}

std::vector<Vertex> BestApart(std::vector<Vertex> vertices,
                              std::size_t count,
                              double distance,
                              const std::vector<bool>& periodic) {
  std::stable_sort(vertices.begin(), vertices.end(), [](const Vertex& a, const Vertex& b) {
    return a.energy < b.energy;
  });
  std::vector<Vertex> kept;
  for (const Vertex& vertex : vertices) {
    if (kept.size() == count) break;
    const bool apart = std::all_of(kept.begin(), kept.end(), [&](const Vertex& other) {
      return Apart(vertex.point, other.point, periodic, distance);
    });
    if (apart && std::isfinite(vertex.energy)) kept.push_back(vertex);
  }
  return kept;
}

}  // namespace ridgeline
