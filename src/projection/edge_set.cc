// SPDX-License-Identifier: Apache-2.0
#include "projection/edge_set.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>
#include <unordered_map>

#include "base/random.h"

namespace ridgeline {
namespace {

constexpr int kClusterSize = 8;
constexpr float kShortest = 1e-3f;  // edge that is looked at [m]
// A face looks away only if the eye lies this far behind its plane [m]: model faces are not planar
// to the centimetre.
constexpr float kFacingTolerance = 0.05f;
// Dihedral angles of weak folds: above the first, the planes differ by more than the noise of
// coordinates; at the second even a coarse model's feature edges begin [rad].
constexpr double kLeastWeakFold = 0.5 * std::numbers::pi / 180.0;
constexpr double kSameLine = 0.05;  // [m]
constexpr double kLargestWeakFold = 30.0 * std::numbers::pi / 180.0;

// Vertices by their exact position.
class VertexIndex {
 public:
  explicit VertexIndex(const CityModel& model) : model_(model) {
    for (std::size_t i = 0; i < model.vertices.size(); ++i) {
      by_hash_.emplace(Hash(model.vertices[i]), static_cast<std::uint32_t>(i));
    }
  }
  std::uint32_t Find(const Eigen::Vector3d& point) const {
    const auto found = by_hash_.find(Hash(point));
    if (found == by_hash_.end() || model_.vertices[found->second] != point) return kNoSurface;
    return found->second;
  }

 private:
  static std::uint64_t Hash(const Eigen::Vector3d& p) {
    // + 0.0 makes one of the two zeros.
    const auto bits = [](double value) { return std::bit_cast<std::uint64_t>(value + 0.0); };
    return MixBits(bits(p.x()) ^ MixBits(bits(p.y()) ^ MixBits(bits(p.z()))));
  }
  const CityModel& model_;
  std::unordered_map<std::uint64_t, std::uint32_t> by_hash_;
};

Eigen::Vector3d TriangleNormal(const CityModel& model, std::uint32_t triangle) {
  const auto& v = model.triangles[triangle].vertices;
  const Eigen::Vector3d n = (model.vertices[v[1]] - model.vertices[v[0]])
                                .cross(model.vertices[v[2]] - model.vertices[v[0]]);
  const double length = n.norm();
  return length > 1e-6 ? Eigen::Vector3d(n / length) : Eigen::Vector3d::Zero();
}

// Whether the third corner of the triangle at `side` lies above the plane of another face.
bool IsConcave(const CityModel& model,
               const TriangleEdge& edge,
               const TriangleSide& side,
               const Eigen::Vector3d& other_normal) {
  return other_normal.dot(model.vertices[side.opposite] - model.vertices[edge.v0]) > 0.0;
}

// The feature edges of each surface, to tell whether a fold of the mesh lies on one of them (which
// may be longer: the city module joins the pieces of one line).
class FeatureEdgesOfSurfaces {
 public:
  explicit FeatureEdgesOfSurfaces(const CityModel& model) : model_(model) {
    for (std::size_t i = 0; i < model.feature_edges.size(); ++i) {
      const FeatureEdge& edge = model.feature_edges[i];
      for (const std::uint32_t surface : {edge.surface0, edge.surface1}) {
        if (surface != kNoSurface) edges_.emplace(surface, static_cast<std::uint32_t>(i));
      }
    }
  }
  bool Contain(std::uint32_t surface, const Eigen::Vector3d& point) const {
    const auto [begin, end] = edges_.equal_range(surface);
    return std::any_of(begin, end, [&](const auto& entry) {
      const FeatureEdge& edge = model_.feature_edges[entry.second];
      const Eigen::Vector3d along = edge.b - edge.a;
      const double t = std::clamp((point - edge.a).dot(along) / along.squaredNorm(), 0.0, 1.0);
      return (edge.a + t * along - point).norm() < kSameLine;
    });
  }

 private:
  const CityModel& model_;
  std::unordered_multimap<std::uint32_t, std::uint32_t> edges_;
};

SceneEdge MakeEdge(const FeatureEdge& edge, std::uint32_t index) {
  SceneEdge result;
  result.a = edge.a.cast<float>();
  result.b = edge.b.cast<float>();
  result.length = (result.b - result.a).norm();
  result.index = index;
  result.has_face1 = edge.surface1 != kNoSurface;
  return result;
}

// Without tolerance: of a chain of weak folds one is always the silhouette.
bool IsSilhouette(const SceneEdge& edge, const Eigen::Vector3f& eye) {
  const Eigen::Vector3f from_edge = eye - edge.a;
  return (edge.normal0.dot(from_edge) > 0.0f) != (edge.normal1.dot(from_edge) > 0.0f);
}

}  // namespace

Facing FacingOf(const SceneEdge& edge, const Eigen::Vector3f& eye) {
  const Eigen::Vector3f from_edge = eye - edge.a;
  return {edge.normal0.dot(from_edge) > -kFacingTolerance,
          edge.normal1.dot(from_edge) > -kFacingTolerance};
}

EdgeSet::EdgeSet(const CityModel& model, const TriangleEdges& mesh)
    : closed_(ClosedBuildings(model, mesh)), matched_(mesh.edges.size(), 0) {
  AddFeatureEdges(model, mesh);
  AddWeakFolds(model, mesh);
  BuildTree();
  closed_ = {};
  matched_ = {};
}

void EdgeSet::AddFeatureEdges(const CityModel& model, const TriangleEdges& mesh) {
  const VertexIndex vertices(model);
  const auto is_closed = [&](std::uint32_t surface) {
    return surface != kNoSurface && closed_[model.surfaces[surface].building];
  };
  for (std::size_t i = 0; i < model.feature_edges.size(); ++i) {
    const FeatureEdge& feature = model.feature_edges[i];
    SceneEdge edge = MakeEdge(feature, static_cast<std::uint32_t>(i));
    if (feature.surface0 != kNoSurface) edge.normal0 = model.surfaces[feature.surface0].normal;
    if (edge.has_face1) edge.normal1 = model.surfaces[feature.surface1].normal;
    edge.closed =
        edge.has_face1 && is_closed(feature.surface0) && is_closed(feature.surface1) &&
        model.surfaces[feature.surface0].building == model.surfaces[feature.surface1].building;
    const std::uint32_t a = vertices.Find(feature.a);
    const std::uint32_t b = vertices.Find(feature.b);
    const TriangleEdge* const found =
        a == kNoSurface || b == kNoSurface ? nullptr : mesh.Find(a, b);
    if (found != nullptr) {
      matched_[static_cast<std::size_t>(found - mesh.edges.data())] = 1;
      // The triangle's own plane, where the polygon is not quite planar.
      for (std::uint32_t k = found->first; k < found->first + found->count; ++k) {
        const TriangleSide& side = mesh.sides[k];
        const std::uint32_t surface = model.triangles[side.triangle].surface;
        const Eigen::Vector3d normal = TriangleNormal(model, side.triangle);
        if (normal.isZero()) continue;
        if (surface == feature.surface0) {
          edge.normal0 = normal.cast<float>();
          edge.known = edge.has_face1;
          edge.concave = IsConcave(model, *found, side, edge.normal1.cast<double>());
        } else if (surface == feature.surface1) {
          edge.normal1 = normal.cast<float>();
        }
      }
    }
    edges_.push_back(edge);
  }
}

void EdgeSet::AddWeakFolds(const CityModel& model, const TriangleEdges& mesh) {
  const FeatureEdgesOfSurfaces feature_edges(model);
  for (std::size_t i = 0; i < mesh.edges.size(); ++i) {
    const TriangleEdge& edge = mesh.edges[i];
    if (matched_[i] || edge.count != 2) continue;
    const TriangleSide& side0 = mesh.sides[edge.first];
    const TriangleSide& side1 = mesh.sides[edge.first + 1];
    if (side0.forward == side1.forward) continue;
    const Eigen::Vector3d normal0 = TriangleNormal(model, side0.triangle);
    const Eigen::Vector3d normal1 = TriangleNormal(model, side1.triangle);
    if (normal0.isZero() || normal1.isZero()) continue;
    const double angle = std::atan2(normal0.cross(normal1).norm(), normal0.dot(normal1));
    if (angle < kLeastWeakFold || angle > kLargestWeakFold) continue;
    const FeatureEdge fold{model.vertices[edge.v0],
                           model.vertices[edge.v1],
                           model.triangles[side0.triangle].surface,
                           model.triangles[side1.triangle].surface};
    if (feature_edges.Contain(fold.surface0, 0.5 * (fold.a + fold.b))) continue;
    SceneEdge scene_edge =
        MakeEdge(fold, static_cast<std::uint32_t>(model.feature_edges.size() + weak_folds_.size()));
    scene_edge.normal0 = normal0.cast<float>();
    scene_edge.normal1 = normal1.cast<float>();
    scene_edge.weak = true;
    scene_edge.known = true;
    scene_edge.concave = IsConcave(model, edge, side0, normal1);
    weak_folds_.push_back(fold);
    edges_.push_back(scene_edge);
  }
}

void EdgeSet::BuildTree() {
  std::vector<Eigen::AlignedBox3f> boxes(edges_.size());
  for (std::size_t i = 0; i < edges_.size(); ++i) boxes[i].extend(edges_[i].a).extend(edges_[i].b);
  const BoxTree tree = BuildBoxTree(boxes, kClusterSize);
  if (tree.nodes.empty()) return;
  std::vector<SceneEdge> ordered;
  ordered.reserve(edges_.size());
  AddCluster(tree, 0, edges_, ordered);
  edges_ = std::move(ordered);
}

std::uint32_t EdgeSet::AddCluster(const BoxTree& tree,
                                  std::int32_t child,
                                  const std::vector<SceneEdge>& edges,
                                  std::vector<SceneEdge>& ordered) {
  const auto index = static_cast<std::uint32_t>(clusters_.size());
  clusters_.emplace_back();
  Cluster cluster;
  if (child < 0) {
    cluster.first = static_cast<std::uint32_t>(ordered.size());
    for (const std::uint32_t i : tree.leaves[static_cast<std::size_t>(~child)].primitives) {
      cluster.box.extend(edges[i].a).extend(edges[i].b);
      cluster.longest = std::max(cluster.longest, edges[i].length);
      ordered.push_back(edges[i]);
    }
    cluster.count = static_cast<std::uint32_t>(ordered.size()) - cluster.first;
  } else {
    for (const std::int32_t next : tree.nodes[static_cast<std::size_t>(child)].children) {
      if (next == BoxTree::kNone) continue;
      const Cluster& part = clusters_[AddCluster(tree, next, edges, ordered)];
      cluster.box.extend(part.box);
      cluster.longest = std::max(cluster.longest, part.longest);
    }
  }
  cluster.skip = static_cast<std::uint32_t>(clusters_.size());
  clusters_[index] = cluster;
  return index;
}

bool EdgeSet::MayFace(const SceneEdge& edge, const Eigen::Vector3f& eye) {
  if (edge.length < kShortest || (edge.weak && !IsSilhouette(edge, eye))) return false;
  if (!edge.closed) return true;
  const Facing facing = FacingOf(edge, eye);
  // The sight of a concave fold lies between its two faces.
  return edge.known && edge.concave ? facing.front0 && facing.front1
                                    : facing.front0 || facing.front1;
}

}  // namespace ridgeline
