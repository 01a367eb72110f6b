// SPDX-License-Identifier: Apache-2.0
#include "projection/horizon.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "projection/fast_angle.h"

namespace ridgeline {
namespace {

constexpr int kEdgesInBox = 8;
constexpr double kTurn = 2.0 * std::numbers::pi;

Eigen::Vector3d Normal(const CityModel& model, std::uint32_t triangle) {
  const auto& v = model.triangles[triangle].vertices;
  return (model.vertices[v[1]] - model.vertices[v[0]])
      .cross(model.vertices[v[2]] - model.vertices[v[0]])
      .normalized();
}

// Diagonals of plane polygons are never higher than the polygon's border.
bool IsFlat(const CityModel& model, const TriangleEdges& mesh, const TriangleEdge& edge) {
  if (edge.count != 2) return false;
  const Eigen::Vector3d n0 = Normal(model, mesh.sides[edge.first].triangle);
  const Eigen::Vector3d n1 = Normal(model, mesh.sides[edge.first + 1].triangle);
  const TriangleSide& side0 = mesh.sides[edge.first];
  const TriangleSide& side1 = mesh.sides[edge.first + 1];
  return side0.forward != side1.forward && n0.dot(n1) > 1.0 - 1e-10;
}

std::vector<std::pair<std::uint32_t, std::uint32_t>> UniqueEdges(const TerrainMesh& terrain) {
  std::vector<std::pair<std::uint32_t, std::uint32_t>> edges;
  edges.reserve(3 * terrain.triangles.size());
  for (const auto& triangle : terrain.triangles) {
    for (int k = 0; k < 3; ++k) edges.push_back(std::minmax(triangle[k], triangle[(k + 1) % 3]));
  }
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  return edges;
}

}  // namespace

// The elevations' tangents at the columns of one query.
class Horizon::Envelope {
 public:
  Envelope(const Horizon& horizon, const Columns& columns, std::vector<float>& tangents)
      : horizon_(horizon),
        columns_(columns),
        per_step_(static_cast<float>(1.0 / horizon.step_)),
        tangents_(tangents) {
    tangents_.assign(static_cast<std::size_t>(columns.count), 0.0f);
  }

  // Whether a box that the eye stands beside could raise it.
  bool CanRaise(const Eigen::Vector3f& center, const Eigen::Vector3f& extent) const {
    const float top = center.z() + extent.z();
    if (top <= 0.0f) return false;  // the horizontal is the least
    const Eigen::Vector2f low = (center - extent).head<2>();
    const Eigen::Vector2f high = (center + extent).head<2>();
    // Where the box lies: -1, 0 or 1 to the east and to the north.
    const int east = (low.x() > 0.0f) - (high.x() < 0.0f);
    const int north = (low.y() > 0.0f) - (high.y() < 0.0f);
    if (east == 0 && north == 0) return true;
    // Its corners at the smallest and the largest azimuth.
    const float start = FastAzimuth(north > 0 || (north == 0 && east > 0) ? low.x() : high.x(),
                                    east > 0 || (east == 0 && north < 0) ? high.y() : low.y());
    const float end = FastAzimuth(north > 0 || (north == 0 && east < 0) ? high.x() : low.x(),
                                  east < 0 || (east == 0 && north < 0) ? high.y() : low.y());
    const float nearest =
        std::hypot(std::max({low.x(), -high.x(), 0.0f}), std::max({low.y(), -high.y(), 0.0f}));
    const float tangent = top / nearest;
    bool can = false;
    ForColumns(start, end, [&](int first, int count, const float*, const float*) {
      for (int k = first; k < first + count && !can; ++k) can = tangents_[k] < tangent;
    });
    return can;
  }

  // Raises the envelope to the edge a-b (relative to the eye).
  void Raise(const Eigen::Vector3f& a, const Eigen::Vector3f& b) {
    const float turn = a.y() * b.x() - a.x() * b.y();  // > 0: clockwise from a to b
    if (turn == 0.0f) return;  // seen from its end: its neighbours have the same columns
    const Eigen::Vector3f& start = turn > 0.0f ? a : b;
    const Eigen::Vector3f& end = turn > 0.0f ? b : a;
    // Points of the edge's plane through the eye obey normal * p = 0; normal.z = -|turn|.
    const Eigen::Vector3f normal = start.cross(end);
    const float east = -normal.x() / normal.z();
    const float north = -normal.y() / normal.z();
    ForColumns(FastAzimuth(start.x(), start.y()),
               FastAzimuth(end.x(), end.y()),
               [&](int first, int count, const float* sines, const float* cosines) {
                 float* const tangents = tangents_.data() + first;
                 for (int k = 0; k < count; ++k) {
                   const float tangent = east * sines[k] + north * cosines[k];
                   tangents[k] = tangents[k] < tangent ? tangent : tangents[k];
                 }
               });
  }

 private:
  // Calls visit(first column of the query, count, their sines, their cosines) for the columns from
  // azimuth `start` clockwise to `end`, both in (-pi, pi].
  template <typename Visit>
  void ForColumns(float start, float end, const Visit& visit) const {
    const int turn = horizon_.turn_;
    const int begin = static_cast<int>(std::ceil(start * per_step_));
    int last = static_cast<int>(std::floor(end * per_step_));
    if (end < start) last += turn;
    // The interval and its copies a turn before and after.
    for (const int shift : {-turn, 0, turn}) {
      const int low = std::max(begin + shift, columns_.first);
      const int count = std::min(last + shift, columns_.first + columns_.count - 1) - low + 1;
      if (count <= 0) continue;
      const int direction = ((low % turn) + turn) % turn;
      visit(low - columns_.first,
            count,
            horizon_.sines_.data() + direction,
            horizon_.cosines_.data() + direction);
    }
  }

  const Horizon& horizon_;
  const Columns columns_;
  const float per_step_;
  std::vector<float>& tangents_;
};

Horizon::Horizon(const CityModel& model,
                 const TriangleEdges& mesh,
                 const TerrainMesh& terrain,
                 double step_rad) {
  turn_ = std::max(1, static_cast<int>(std::ceil(kTurn / step_rad - 1e-9)));
  step_ = kTurn / turn_;
  for (int k = 0; k < 2 * turn_; ++k) {
    sines_.push_back(static_cast<float>(std::sin(k * step_)));
    cosines_.push_back(static_cast<float>(std::cos(k * step_)));
  }
  for (const TriangleEdge& edge : mesh.edges) {
    if (IsFlat(model, mesh, edge)) continue;
    edges_.push_back(
        {model.vertices[edge.v0].cast<float>(), model.vertices[edge.v1].cast<float>()});
  }
  for (const auto& [v0, v1] : UniqueEdges(terrain)) {
    edges_.push_back({terrain.vertices[v0], terrain.vertices[v1]});
  }
  BuildTree();
}

void Horizon::BuildTree() {
  std::vector<Eigen::AlignedBox3f> boxes(edges_.size());
  for (std::size_t i = 0; i < edges_.size(); ++i) boxes[i].extend(edges_[i].a).extend(edges_[i].b);
  const BoxTree tree = BuildBoxTree(boxes, kEdgesInBox);
  if (tree.nodes.empty()) return;
  std::vector<Edge> ordered;
  ordered.reserve(edges_.size());
  AddCluster(tree, 0, ordered);
  edges_ = std::move(ordered);
}

void Horizon::AddCluster(const BoxTree& tree, std::int32_t child, std::vector<Edge>& ordered) {
  const std::size_t index = clusters_.size();
  clusters_.emplace_back();
  Cluster cluster;
  if (child < 0) {
    cluster.first = static_cast<std::uint32_t>(ordered.size());
    for (const std::uint32_t i : tree.leaves[static_cast<std::size_t>(~child)].primitives) {
      cluster.box.extend(edges_[i].a).extend(edges_[i].b);
      ordered.push_back(edges_[i]);
    }
    cluster.count = static_cast<std::uint32_t>(ordered.size()) - cluster.first;
  } else {
    for (const std::int32_t next : tree.nodes[static_cast<std::size_t>(child)].children) {
      if (next == BoxTree::kNone) continue;
      const std::size_t part = clusters_.size();
      AddCluster(tree, next, ordered);
      cluster.box.extend(clusters_[part].box);
    }
  }
  cluster.skip = static_cast<std::uint32_t>(clusters_.size());
  clusters_[index] = cluster;
}

Horizon::Columns Horizon::ColumnsOf(double center, double half_width) const {
  if (half_width >= std::numbers::pi) return {0, turn_};
  center -= kTurn * std::round(center / kTurn);
  const int first = static_cast<int>(std::ceil((center - half_width) / step_));
  const int last = static_cast<int>(std::floor((center + half_width) / step_));
  return {first, std::clamp(last - first + 1, 0, turn_)};
}

void Horizon::Elevations(const Eigen::Vector3f& eye,
                         const Columns& columns,
                         const SectorTest& sector,
                         std::vector<float>& elevations) const {
  Envelope envelope(*this, columns, elevations);
  for (std::uint32_t i = 0; i < clusters_.size();) {
    const Cluster& cluster = clusters_[i];
    const Eigen::Vector3f center = cluster.box.center() - eye;
    const Eigen::Vector3f extent = 0.5f * cluster.box.sizes();
    if (!sector.MayContainBox(center, extent) || !envelope.CanRaise(center, extent)) {
      i = cluster.skip;
      continue;
    }
    for (std::uint32_t k = cluster.first; k < cluster.first + cluster.count; ++k) {
      const Eigen::Vector3f a = edges_[k].a - eye;
      const Eigen::Vector3f b = edges_[k].b - eye;
      if (a.z() > 0.0f || b.z() > 0.0f) envelope.Raise(a, b);
    }
    ++i;
  }
  for (float& elevation : elevations) elevation = FastAtan(elevation);
}

}  // namespace ridgeline
