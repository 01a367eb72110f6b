// SPDX-License-Identifier: Apache-2.0
#include "projection/horizon.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace ridgeline {
namespace {

constexpr int kClusterSize = 8;
constexpr double kTurn = 2.0 * std::numbers::pi;

Eigen::Vector3d Normal(const CityModel& model, std::uint32_t triangle) {
  const auto& v = model.triangles[triangle].vertices;
  return (model.vertices[v[1]] - model.vertices[v[0]])
      .cross(model.vertices[v[2]] - model.vertices[v[0]])
      .normalized();
}

// Diagonals of plane polygons are never higher than the polygon's border.
bool IsFlat(const CityModel& model, const MeshEdges& mesh, const MeshEdge& edge) {
  if (edge.count != 2) return false;
  const Eigen::Vector3d n0 = Normal(model, mesh.sides[edge.first].triangle);
  const Eigen::Vector3d n1 = Normal(model, mesh.sides[edge.first + 1].triangle);
  const MeshSide& side0 = mesh.sides[edge.first];
  const MeshSide& side1 = mesh.sides[edge.first + 1];
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
        turn_(static_cast<int>(horizon.directions_.size())),
        tangents_(tangents) {
    tangents_.assign(static_cast<std::size_t>(columns.count), 0.0f);
  }

  // Whether something at azimuths [from, from + width] (rad) up to a tangent could raise it.
  bool CanRaise(float from, float width, float tangent) const {
    bool can = false;
    ForColumns(from, width, [&](int column, int) { can = can || tangents_[column] < tangent; });
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
    const float from = Azimuth(start);
    float width = Azimuth(end) - from;
    if (width < 0.0f) width += static_cast<float>(kTurn);
    const float east = -normal.x() / normal.z();
    const float north = -normal.y() / normal.z();
    ForColumns(from, width, [&](int column, int direction) {
      const Eigen::Vector2f& d = horizon_.directions_[static_cast<std::size_t>(direction)];
      tangents_[column] = std::max(tangents_[column], east * d.x() + north * d.y());
    });
  }

  static float Azimuth(const Eigen::Vector3f& p) { return std::atan2(p.x(), p.y()); }

 private:
  // Calls visit(column of the query, index of its direction) for the columns in the interval.
  template <typename Visit>
  void ForColumns(float from, float width, const Visit& visit) const {
    const double step = horizon_.step_;
    const int begin = static_cast<int>(std::ceil(from / step));
    const int end = static_cast<int>(std::floor((static_cast<double>(from) + width) / step));
    // The interval and its copies one turn before and after.
    for (int shift = -turn_; shift <= turn_; shift += turn_) {
      const int low = std::max(begin + shift, columns_.first);
      const int high = std::min(end + shift, columns_.first + columns_.count - 1);
      int direction = ((low % turn_) + turn_) % turn_;
      for (int k = low; k <= high; ++k) {
        visit(k - columns_.first, direction);
        if (++direction == turn_) direction = 0;
      }
    }
  }

  const Horizon& horizon_;
  const Columns columns_;
  const int turn_;
  std::vector<float>& tangents_;
};

Horizon::Horizon(const CityModel& model,
                 const MeshEdges& mesh,
                 const TerrainMesh& terrain,
                 double step_rad) {
  const int columns = std::max(1, static_cast<int>(std::ceil(kTurn / step_rad - 1e-9)));
  step_ = kTurn / columns;
  directions_.reserve(static_cast<std::size_t>(columns));
  for (int k = 0; k < columns; ++k) {
    directions_.emplace_back(static_cast<float>(std::sin(k * step_)),
                             static_cast<float>(std::cos(k * step_)));
  }
  for (const MeshEdge& edge : mesh.edges) {
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
  const BoxTree tree = BuildBoxTree(boxes, kClusterSize);
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
  const int turn = static_cast<int>(directions_.size());
  if (half_width >= std::numbers::pi) return {0, turn};
  const int first = static_cast<int>(std::ceil((center - half_width) / step_));
  const int last = static_cast<int>(std::floor((center + half_width) / step_));
  return {first, std::clamp(last - first + 1, 0, turn)};
}

void Horizon::Elevations(const Eigen::Vector3f& eye,
                         const Columns& columns,
                         const SectorTest& sector,
                         std::vector<float>& elevations) const {
  Envelope envelope(*this, columns, elevations);
  // Azimuths and highest tangent of a box; false: it cannot raise the envelope.
  const auto can_raise = [&](const Eigen::Vector3f& center, const Eigen::Vector3f& extent) {
    const float top = center.z() + extent.z();
    const Eigen::Array2f reach = center.head<2>().array().abs();
    const float nearest = (reach - extent.head<2>().array()).max(0.0f).matrix().norm();
    if (nearest <= 1e-3f) return true;
    if (top <= 0.0f) return false;  // the horizontal is the least
    const float from_center = Envelope::Azimuth(center);
    float low = 0.0f;
    float high = 0.0f;
    for (const Eigen::Vector2f& corner :
         {Eigen::Vector2f(1, 1), Eigen::Vector2f(1, -1), Eigen::Vector2f(-1, 1),
          Eigen::Vector2f(-1, -1)}) {
      const Eigen::Vector2f p = center.head<2>() + corner.cwiseProduct(extent.head<2>());
      const float cross = p.x() * center.y() - p.y() * center.x();
      const float angle = std::atan2(cross, p.dot(center.head<2>()));
      low = std::min(low, angle);
      high = std::max(high, angle);
    }
    return envelope.CanRaise(from_center + low, high - low, top / nearest);
  };
  for (std::uint32_t i = 0; i < clusters_.size();) {
    const Cluster& cluster = clusters_[i];
    const Eigen::Vector3f center = cluster.box.center() - eye;
    const Eigen::Vector3f extent = 0.5f * cluster.box.sizes();
    if (!sector.MayContainBox(center, extent) || !can_raise(center, extent)) {
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
  for (float& elevation : elevations) elevation = std::atan(elevation);
}

}  // namespace ridgeline
