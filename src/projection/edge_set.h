// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <cstdint>
#include <vector>

#include "city/city_model.h"
#include "projection/bvh_build.h"
#include "projection/sector_test.h"
#include "projection/triangle_edges.h"

namespace ridgeline {

// A model edge prepared for questions from many positions.
struct SceneEdge {
  Eigen::Vector3f a = Eigen::Vector3f::Zero();
  Eigen::Vector3f b = Eigen::Vector3f::Zero();
  Eigen::Vector3f normal0 = Eigen::Vector3f::Zero();  // of its faces, unit, outward
  Eigen::Vector3f normal1 = Eigen::Vector3f::Zero();
  float length = 0.0f;
  std::uint32_t index = 0;  // in CityModel::feature_edges, beyond them a weak fold
  bool has_face1 = false;
  bool weak = false;    // a fold below the model's least angle: seen as a silhouette only
  bool closed = false;  // of a closed shell: hidden if both faces look away
  bool known = false;   // whether `concave` could be found out
  bool concave = false;
};

// Which faces look at a position.
struct Facing {
  bool front0 = true;
  bool front1 = true;
};

Facing FacingOf(const SceneEdge& edge, const Eigen::Vector3f& eye);

// Feature edges of a model and its weak folds, in a hierarchy that skips what is far, small or
// outside a sector as a whole.
class EdgeSet {
 public:
  EdgeSet(const CityModel& model, const TriangleEdges& mesh);

  // Calls visit(edge, a, b, distance) for edges that may be seen, with their ends relative to the
  // eye and their distance from it [m]: within the distance and the sector, long enough at their
  // distance [rad], and not looking away. Clusters whose box (centre relative to the eye, half
  // sizes) is_hidden(center, extent) says to be hidden are skipped. In the order of the hierarchy:
  // neighbours follow each other.
  template <typename IsHidden, typename Visit>
  void ForCandidates(const Eigen::Vector3f& eye,
                     const SectorTest& sector,
                     float max_distance_m,
                     float min_angle,
                     const IsHidden& is_hidden,
                     const Visit& visit) const;

  const std::vector<SceneEdge>& edges() const { return edges_; }
  // Folds below the model's least angle; they follow the feature edges in SceneEdge::index.
  const std::vector<FeatureEdge>& weak_folds() const { return weak_folds_; }
  std::size_t memory_bytes() const {
    return edges_.size() * sizeof(SceneEdge) + weak_folds_.size() * sizeof(FeatureEdge) +
           clusters_.size() * sizeof(Cluster);
  }

 private:
  // Whether the faces of an edge allow it to be seen.
  static bool MayFace(const SceneEdge& edge, const Eigen::Vector3f& eye);
  void AddFeatureEdges(const CityModel& model, const TriangleEdges& mesh);
  void AddWeakFolds(const CityModel& model, const TriangleEdges& mesh);
  void BuildTree();

  struct Cluster {
    Eigen::AlignedBox3f box;
    float longest = 0.0f;     // edge in it [m]
    std::uint32_t first = 0;  // edges of a leaf
    std::uint32_t count = 0;  // 0: inner
    std::uint32_t skip = 0;   // next cluster if this one is skipped
  };
  std::uint32_t AddCluster(const BoxTree& tree,
                           std::int32_t child,
                           const std::vector<SceneEdge>& edges,
                           std::vector<SceneEdge>& ordered);

  std::vector<SceneEdge> edges_;  // in the order of the clusters
  std::vector<FeatureEdge> weak_folds_;
  std::vector<char> closed_;       // per building, while building
  std::vector<char> matched_;      // per mesh edge, while building
  std::vector<Cluster> clusters_;  // depth first
};

template <typename IsHidden, typename Visit>
void EdgeSet::ForCandidates(const Eigen::Vector3f& eye,
                            const SectorTest& sector,
                            float max_distance_m,
                            float min_angle,
                            const IsHidden& is_hidden,
                            const Visit& visit) const {
  for (std::uint32_t i = 0; i < clusters_.size();) {
    const Cluster& cluster = clusters_[i];
    const Eigen::Vector3f center = cluster.box.center() - eye;
    const Eigen::Vector3f extent = 0.5f * cluster.box.sizes();
    const float nearest = (center.cwiseAbs() - extent).cwiseMax(0.0f).norm();
    if (nearest > max_distance_m || cluster.longest < min_angle * nearest ||
        !sector.MayContainBox(center, extent) || is_hidden(center, extent)) {
      i = cluster.skip;
      continue;
    }
    for (std::uint32_t k = cluster.first; k < cluster.first + cluster.count; ++k) {
      const SceneEdge& edge = edges_[k];
      if (!MayFace(edge, eye)) continue;
      const Eigen::Vector3f a = edge.a - eye;
      const Eigen::Vector3f b = edge.b - eye;
      if (!sector.MayContainSegment(a, b)) continue;
      const Eigen::Vector3f along = b - a;
      const float t = std::clamp(-a.dot(along) / along.squaredNorm(), 0.0f, 1.0f);
      const float distance = (a + t * along).norm();
      if (distance > max_distance_m || edge.length < min_angle * distance) continue;
      visit(edge, a, b, distance);
    }
    ++i;
  }
}

}  // namespace ridgeline
