// SPDX-License-Identifier: Apache-2.0
#include "city/mesh/triangulate.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace ridgeline {
namespace {

// One simple ring of indices in which holes hang on bridges that are walked twice.
class EarClipper {
 public:
  explicit EarClipper(const PlanarPolygon& polygon) : points_(polygon.points) {
    for (std::uint32_t i = 0; i < polygon.ring_ends.front(); ++i) ring_.push_back(i);
    JoinHoles(polygon);
  }

  std::vector<TriangleIndices> Clip() {
    std::vector<TriangleIndices> triangles;
    if (ring_.size() < 3) return triangles;
    triangles.reserve(ring_.size());
    std::size_t i = 0;
    std::size_t tries = 0;
    left_ = kTests + kTestsPerPair * ring_.size() * ring_.size();
    while (ring_.size() > 3) {
      const std::size_t n = ring_.size();
      i %= n;
      if (IsEar(i) || ((tries >= n || left_ == 0) && IsEarInEmergency(i)) || tries >= 2 * n) {
        Cut(i, triangles);
        // Going on two corners further avoids fans of slivers.
        ++i;
        tries = 0;
      } else {
        ++i;
        ++tries;
      }
    }
    Cut(1, triangles);
    return triangles;
  }

 private:
  // Corners that may be looked at: simple rings need fewer, those that cross themselves everywhere
  // would go on for the cube of their corners.
  static constexpr std::size_t kTests = 10'000'000;
  static constexpr std::size_t kTestsPerPair = 1;

  const Eigen::Vector2d& At(std::size_t i) const { return points_[ring_[i % ring_.size()]]; }

  void Cut(std::size_t i, std::vector<TriangleIndices>& triangles) {
    const std::size_t n = ring_.size();
    const TriangleIndices t{ring_[(i + n - 1) % n], ring_[i], ring_[(i + 1) % n]};
    if (Cross(points_[t[0]], points_[t[1]], points_[t[2]]) > 0.0) triangles.push_back(t);
    ring_.erase(ring_.begin() + static_cast<std::ptrdiff_t>(i));
  }

  // A convex corner whose triangle holds no other corner of the ring. Points that coincide with the
  // triangle's own corners (the other side of a bridge) do not count.
  bool IsEar(std::size_t i) {
    if (left_ == 0) return false;
    const std::size_t n = ring_.size();
    const Eigen::Vector2d& a = At(i + n - 1);
    const Eigen::Vector2d& b = At(i);
    const Eigen::Vector2d& c = At(i + 1);
    const double area = Cross(a, b, c);
    // A straight corner can always go; so can one where the ring turns back on itself.
    if (area <= 0.0) return area == 0.0;
    for (std::size_t k = 2; k + 1 < n && left_ > 0; ++k) {
      --left_;
      const Eigen::Vector2d& p = At(i + k);
      if (p == a || p == b || p == c) continue;
      if (Cross(a, b, p) >= 0.0 && Cross(b, c, p) >= 0.0 && Cross(c, a, p) >= 0.0) {
        // On the far side of the cut only corners that reach into the triangle matter.
        if (Cross(c, a, p) > 0.0 || ReachesInto(i + k, a, c)) return false;
      }
    }
    return true;
  }

  // Whether the ring at corner k, which lies on the line c-a, goes to the triangle's side of it.
  bool ReachesInto(std::size_t k, const Eigen::Vector2d& a, const Eigen::Vector2d& c) const {
    const std::size_t n = ring_.size();
    return Cross(c, a, At(k + n - 1)) > 0.0 || Cross(c, a, At(k + 1)) > 0.0;
  }

  // For rings that cross themselves by a hair: any convex or straight corner.
  bool IsEarInEmergency(std::size_t i) const {
    const std::size_t n = ring_.size();
    return Cross(At(i + n - 1), At(i), At(i + 1)) >= 0.0;
  }

  void JoinHoles(const PlanarPolygon& polygon) {
    struct Hole {
      std::uint32_t begin, end, rightmost;
    };
    std::vector<Hole> holes;
    for (std::size_t r = 1; r < polygon.ring_ends.size(); ++r) {
      Hole hole{polygon.ring_ends[r - 1], polygon.ring_ends[r], polygon.ring_ends[r - 1]};
      for (std::uint32_t i = hole.begin; i < hole.end; ++i) {
        if (points_[i].x() > points_[hole.rightmost].x()) hole.rightmost = i;
      }
      if (hole.end - hole.begin >= 3) holes.push_back(hole);
    }
    std::sort(holes.begin(), holes.end(), [this](const Hole& a, const Hole& b) {
      return points_[a.rightmost].x() > points_[b.rightmost].x();
    });
    for (const Hole& hole : holes) {
      const std::size_t bridge = FindBridge(points_[hole.rightmost]);
      std::vector<std::uint32_t> inserted;
      for (std::uint32_t i = hole.rightmost; i < hole.end; ++i) inserted.push_back(i);
      for (std::uint32_t i = hole.begin; i <= hole.rightmost; ++i) inserted.push_back(i);
      inserted.push_back(ring_[bridge]);
      ring_.insert(ring_.begin() + static_cast<std::ptrdiff_t>(bridge) + 1,
                   inserted.begin(),
                   inserted.end());
    }
  }

  // Corner of the ring that `from`, the rightmost point of a hole, can be joined to.
  std::size_t FindBridge(const Eigen::Vector2d& from) const {
    // The first edge hit by a ray to the right.
    double best_x = std::numeric_limits<double>::infinity();
    std::size_t best = 0;
    const std::size_t n = ring_.size();
    for (std::size_t i = 0; i < n; ++i) {
      const Eigen::Vector2d& a = At(i);
      const Eigen::Vector2d& b = At(i + 1);
      if (a == from) return BestCopy(i, from);
      // The interior is left of each edge: one that the ray leaves through goes upwards.
      if (a.y() > from.y() || b.y() < from.y() || a.y() == b.y()) continue;
      const double x = a.x() + (from.y() - a.y()) / (b.y() - a.y()) * (b.x() - a.x());
      if (x < from.x() || x >= best_x) continue;
      best_x = x;
      best = a.x() > b.x() ? i : (i + 1) % n;
    }
    if (!std::isfinite(best_x)) return Nearest(from);
    // A reflex corner inside the triangle (from, hit, corner) would be crossed: take the one of the
    // smallest angle to the ray instead.
    const Eigen::Vector2d hit(best_x, from.y());
    const Eigen::Vector2d corner = At(best);
    double best_slope = std::numeric_limits<double>::infinity();
    std::size_t chosen = best;
    for (std::size_t i = 0; i < n; ++i) {
      const Eigen::Vector2d& p = At(i);
      if (p.x() < from.x() || p == corner || !InTriangle(from, hit, corner, p)) continue;
      if (p.x() == from.x()) continue;
      const double slope = std::abs(p.y() - from.y()) / (p.x() - from.x());
      if (slope < best_slope || (slope == best_slope && p.x() < At(chosen).x())) {
        best_slope = slope;
        chosen = i;
      }
    }
    return BestCopy(chosen, from);
  }

  // Bridges leave several copies of a corner in the ring: takes the one whose inner angle holds
  // `from`.
  std::size_t BestCopy(std::size_t corner, const Eigen::Vector2d& from) const {
    const std::size_t n = ring_.size();
    for (std::size_t i = 0; i < n; ++i) {
      if (At(i) != At(corner)) continue;
      const Eigen::Vector2d& before = At(i + n - 1);
      const Eigen::Vector2d& after = At(i + 1);
      const bool convex = Cross(before, At(i), after) >= 0.0;
      const bool left_in = Cross(before, At(i), from) >= 0.0;
      const bool left_out = Cross(At(i), after, from) >= 0.0;
      if (convex ? left_in && left_out : left_in || left_out) return i;
    }
    return corner;
  }

  static bool InTriangle(const Eigen::Vector2d& a,
                         const Eigen::Vector2d& b,
                         const Eigen::Vector2d& c,
                         const Eigen::Vector2d& p) {
    const double ab = Cross(a, b, p);
    const double bc = Cross(b, c, p);
    const double ca = Cross(c, a, p);
    return (ab >= 0.0 && bc >= 0.0 && ca >= 0.0) || (ab <= 0.0 && bc <= 0.0 && ca <= 0.0);
  }

  std::size_t Nearest(const Eigen::Vector2d& from) const {
    std::size_t best = 0;
    for (std::size_t i = 1; i < ring_.size(); ++i) {
      if ((At(i) - from).squaredNorm() < (At(best) - from).squaredNorm()) best = i;
    }
    return best;
  }

  const std::vector<Eigen::Vector2d>& points_;
  std::vector<std::uint32_t> ring_;
  std::size_t left_ = 0;
};

}  // namespace

double SignedArea(std::span<const Eigen::Vector2d> ring) {
  double twice = 0.0;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Eigen::Vector2d& a = ring[i];
    const Eigen::Vector2d& b = ring[(i + 1) % ring.size()];
    twice += a.x() * b.y() - a.y() * b.x();
  }
  return 0.5 * twice;
}

std::vector<TriangleIndices> Triangulate(const PlanarPolygon& polygon) {
  if (polygon.ring_ends.empty()) return {};
  return EarClipper(polygon).Clip();
}

}  // namespace ridgeline
