// SPDX-License-Identifier: Apache-2.0
#include "city/mesh/fold.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace ridgeline {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kSameDirection = 0.087;  // 5 degrees: half-planes that lie on each other
constexpr double kOpposite = -0.9;        // cosine between normals of faces back to back

double AngleBetween(double a, double b) {
  const double difference = std::abs(std::remainder(a - b, 2.0 * kPi));
  return std::min(difference, 2.0 * kPi - difference);
}

}  // namespace

void RemoveHidden(const FaceSet& set, std::vector<HalfPlane>& planes) {
  for (std::size_t i = 0; i < planes.size(); ++i) {
    for (std::size_t j = i + 1; j < planes.size(); ++j) {
      if (AngleBetween(planes[i].angle, planes[j].angle) > kSameDirection) continue;
      const double cosine = set.faces[planes[i].face].normal.dot(set.faces[planes[j].face].normal);
      planes.erase(planes.begin() + static_cast<std::ptrdiff_t>(j));
      if (cosine < kOpposite) planes.erase(planes.begin() + static_cast<std::ptrdiff_t>(i));
      return RemoveHidden(set, planes);
    }
  }
}

Fold SharpestFold(std::vector<HalfPlane>& planes) {
  std::sort(planes.begin(), planes.end(), [](const HalfPlane& a, const HalfPlane& b) {
    return a.angle < b.angle;
  });
  Fold best{0, 1, -1.0};
  Fold best_free{0, 1, -1.0};
  for (std::size_t i = 0; i < planes.size(); ++i) {
    const std::size_t j = (i + 1) % planes.size();
    const double wedge = planes[j].angle - planes[i].angle + (j == 0 ? 2.0 * kPi : 0.0);
    const double fold = std::abs(kPi - wedge);
    const bool is_free = planes[i].free_side > 0.0 && planes[j].free_side < 0.0;
    if (fold > best.angle) best = {i, j, fold};
    if (is_free && fold > best_free.angle) best_free = {i, j, fold};
  }
  return best_free.angle >= 0.0 ? best_free : best;
}

}  // namespace ridgeline
