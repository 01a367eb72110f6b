// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstdint>
#include <vector>

#include "city/city_model.h"
#include "projection/bvh_build.h"
#include "projection/mesh_edges.h"
#include "projection/sector_test.h"

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
  bool weak = false;     // a fold below the model's least angle: seen as a silhouette only
  bool closed = false;   // of a closed shell: hidden if both faces look away
  bool known = false;    // whether `concave` could be found out
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
  EdgeSet(const CityModel& model, const MeshEdges& mesh);

  // Edges that may be seen: within the distance and the sector, long enough at their distance
  // [rad], and not looking away. In the order of the hierarchy: neighbours follow each other.
  void Candidates(const Eigen::Vector3f& eye,
                  const SectorTest& sector,
                  float max_distance_m,
                  float min_angle,
                  std::vector<std::uint32_t>& candidates) const;

  const std::vector<SceneEdge>& edges() const { return edges_; }
  // Folds below the model's least angle; they follow the feature edges in SceneEdge::index.
  const std::vector<FeatureEdge>& weak_folds() const { return weak_folds_; }

 private:
  void AddFeatureEdges(const CityModel& model, const MeshEdges& mesh);
  void AddWeakFolds(const CityModel& model, const MeshEdges& mesh);
  void BuildTree();

  struct Cluster {
    Eigen::AlignedBox3f box;
    float longest = 0.0f;       // edge in it [m]
    std::uint32_t first = 0;    // edges of a leaf
    std::uint32_t count = 0;    // 0: inner
    std::uint32_t skip = 0;     // next cluster if this one is skipped
  };
  std::uint32_t AddCluster(const BoxTree& tree,
                           std::int32_t child,
                           const std::vector<SceneEdge>& edges,
                           std::vector<SceneEdge>& ordered);

  std::vector<SceneEdge> edges_;  // in the order of the clusters
  std::vector<FeatureEdge> weak_folds_;
  std::vector<char> closed_;      // per building, while building
  std::vector<char> matched_;     // per mesh edge, while building
  std::vector<Cluster> clusters_;  // depth first
};

}  // namespace ridgeline
