// SPDX-License-Identifier: Apache-2.0
#include "city/mesh/merge_edges.h"

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <cstdint>
#include <utility>

#include "city/mesh/point_welder.h"

namespace ridgeline {
namespace {

constexpr double kJoin = 0.001;          // [m] between the ends of pieces
constexpr double kStraight = 0.9999;     // cosine, 0.8 degrees
constexpr double kSameNormal = 0.99985;  // 1 degree
constexpr std::uint32_t kNone = 0xFFFFFFFFu;

// An end of an edge: the edge and which of its two ends.
struct End {
  std::uint32_t edge = kNone;
  int side = 0;
};

class Merger {
 public:
  Merger(const FaceSet& set, const std::vector<FeatureEdge>& edges)
      : set_(set), edges_(edges), next_(edges.size()), used_(edges.size(), false) {
    LinkEnds();
  }

  std::vector<FeatureEdge> Run() {
    std::vector<FeatureEdge> merged;
    merged.reserve(edges_.size());
    for (std::uint32_t e = 0; e < edges_.size(); ++e) {
      if (used_[e]) continue;
      used_[e] = true;
      FeatureEdge edge = edges_[e];
      edge.b = FarEnd({e, 1}, edge.b);
      edge.a = FarEnd({e, 0}, edge.a);
      merged.push_back(edge);
    }
    return merged;
  }

 private:
  const Eigen::Vector3d& PointOf(const End& end) const {
    return end.side == 0 ? edges_[end.edge].a : edges_[end.edge].b;
  }

  // From the end into the edge.
  Eigen::Vector3d Inwards(const End& end) const {
    const FeatureEdge& edge = edges_[end.edge];
    const Eigen::Vector3d along = (edge.b - edge.a).normalized();
    return end.side == 0 ? along : Eigen::Vector3d(-along);
  }

  // Pairs each end with the first one at the same place that goes straight on.
  void LinkEnds() {
    PointWelder welder(kJoin);
    std::vector<std::vector<End>> ends_at;
    for (std::uint32_t e = 0; e < edges_.size(); ++e) {
      for (int side = 0; side < 2; ++side) {
        const std::uint32_t node = welder.Add(PointOf({e, side}));
        if (node >= ends_at.size()) ends_at.resize(node + 1);
        ends_at[node].push_back({e, side});
      }
    }
    for (const std::vector<End>& ends : ends_at) {
      for (std::size_t i = 0; i < ends.size(); ++i) {
        for (std::size_t j = i + 1; j < ends.size(); ++j) TryLink(ends[i], ends[j]);
      }
    }
  }

  void TryLink(const End& a, const End& b) {
    if (a.edge == b.edge || Next(a).edge != kNone || Next(b).edge != kNone) return;
    if (Inwards(a).dot(Inwards(b)) > -kStraight) return;
    const FeatureEdge& x = edges_[a.edge];
    const FeatureEdge& y = edges_[b.edge];
    const bool alike = (Alike(x.surface0, y.surface0) && Alike(x.surface1, y.surface1)) ||
                       (Alike(x.surface0, y.surface1) && Alike(x.surface1, y.surface0));
    if (x.seam != y.seam || !alike) return;
    Next(a) = b;
    Next(b) = a;
  }

  bool Alike(std::uint32_t s0, std::uint32_t s1) const {
    if (s0 == s1) return true;
    if (s0 == kNoSurface || s1 == kNoSurface) return false;
    const Face& a = set_.faces[s0];
    const Face& b = set_.faces[s1];
    return a.building == b.building && a.surface_class == b.surface_class &&
           a.normal.dot(b.normal) > kSameNormal;
  }

  End& Next(const End& end) { return next_[end.edge][static_cast<std::size_t>(end.side)]; }

  // Walks on from an end over linked edges, as long as the whole stays straight.
  Eigen::Vector3d FarEnd(End from, const Eigen::Vector3d& start) {
    Eigen::Vector3d reached = start;
    const Eigen::Vector3d outwards = -Inwards(from);
    for (End next = Next(from); next.edge != kNone && !used_[next.edge]; next = Next(from)) {
      from = {next.edge, 1 - next.side};
      if (-outwards.dot(Inwards(from)) < kStraight) break;
      used_[next.edge] = true;
      reached = PointOf(from);
    }
    return reached;
  }

  const FaceSet& set_;
  const std::vector<FeatureEdge>& edges_;
  std::vector<std::array<End, 2>> next_;
  std::vector<bool> used_;
};

}  // namespace

std::vector<FeatureEdge> MergeCollinear(const FaceSet& set, const std::vector<FeatureEdge>& edges) {
  return Merger(set, edges).Run();
}

}  // namespace ridgeline
