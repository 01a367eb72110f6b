// SPDX-License-Identifier: Apache-2.0
#include "projection/triangle_edges.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <string_view>
#include <tuple>
#include <unordered_map>
#include <utility>

namespace ridgeline {
namespace {

struct Half {
  std::uint32_t v0, v1;
  TriangleSide side;
};

std::vector<Half> Halves(const CityModel& model) {
  std::vector<Half> halves;
  halves.reserve(3 * model.triangles.size());
  for (std::size_t i = 0; i < model.triangles.size(); ++i) {
    const auto& v = model.triangles[i].vertices;
    if (v[0] == v[1] || v[1] == v[2] || v[2] == v[0]) continue;
    for (int k = 0; k < 3; ++k) {
      const std::uint32_t a = v[k];
      const std::uint32_t b = v[(k + 1) % 3];
      halves.push_back(
          {std::min(a, b), std::max(a, b), {static_cast<std::uint32_t>(i), v[(k + 2) % 3], a < b}});
    }
  }
  std::sort(halves.begin(), halves.end(), [](const Half& a, const Half& b) {
    return std::tie(a.v0, a.v1, a.side.triangle) < std::tie(b.v0, b.v1, b.side.triangle);
  });
  return halves;
}

// Marks the groups with an edge that is not run through equally often in both directions.
void MarkOpen(const CityModel& model,
              const TriangleEdges& edges,
              const std::vector<std::uint32_t>& group_of_building,
              std::vector<char>& open) {
  std::vector<std::pair<std::uint32_t, int>> balance;  // of the groups at one edge
  for (const TriangleEdge& edge : edges.edges) {
    balance.clear();
    for (std::uint32_t k = edge.first; k < edge.first + edge.count; ++k) {
      const TriangleSide& side = edges.sides[k];
      const Surface& surface = model.surfaces[model.triangles[side.triangle].surface];
      const std::uint32_t group = group_of_building[surface.building];
      auto entry = std::find_if(
          balance.begin(), balance.end(), [&](const auto& b) { return b.first == group; });
      if (entry == balance.end()) entry = balance.insert(balance.end(), {group, 0});
      entry->second += side.forward ? 1 : -1;
    }
    for (const auto& [group, sum] : balance) {
      if (sum != 0) open[group] = 1;
    }
  }
}

std::vector<double> Volumes(const CityModel& model, const std::vector<std::uint32_t>& group) {
  std::vector<double> volumes(model.buildings.size(), 0.0);
  for (const Triangle& triangle : model.triangles) {
    const Eigen::Vector3d& a = model.vertices[triangle.vertices[0]];
    const Eigen::Vector3d& b = model.vertices[triangle.vertices[1]];
    const Eigen::Vector3d& c = model.vertices[triangle.vertices[2]];
    volumes[group[model.surfaces[triangle.surface].building]] += a.dot(b.cross(c)) / 6.0;
  }
  return volumes;
}

}  // namespace

const TriangleEdge* TriangleEdges::Find(std::uint32_t a, std::uint32_t b) const {
  const std::pair key{std::min(a, b), std::max(a, b)};
  const auto found = std::lower_bound(
      edges.begin(), edges.end(), key, [](const TriangleEdge& edge, const auto& wanted) {
        return std::pair{edge.v0, edge.v1} < wanted;
      });
  if (found == edges.end() || std::pair{found->v0, found->v1} != key) return nullptr;
  return &*found;
}

TriangleEdges FindTriangleEdges(const CityModel& model) {
  TriangleEdges result;
  const std::vector<Half> halves = Halves(model);
  result.sides.reserve(halves.size());
  for (const Half& half : halves) {
    const bool is_new = result.edges.empty() || result.edges.back().v0 != half.v0 ||
                        result.edges.back().v1 != half.v1;
    if (is_new) {
      result.edges.push_back(
          {half.v0, half.v1, static_cast<std::uint32_t>(result.sides.size()), 0});
    }
    ++result.edges.back().count;
    result.sides.push_back(half.side);
  }
  return result;
}

std::vector<std::uint32_t> RootBuildings(const CityModel& model) {
  std::unordered_map<std::string_view, std::uint32_t> index_of;
  for (std::size_t i = 0; i < model.buildings.size(); ++i) {
    index_of.emplace(model.buildings[i].id, static_cast<std::uint32_t>(i));
  }
  std::unordered_map<std::string_view, std::uint32_t> root_of;
  std::vector<std::uint32_t> roots(model.buildings.size());
  for (std::size_t i = 0; i < model.buildings.size(); ++i) {
    const Building& building = model.buildings[i];
    const std::string& root = building.parent_id.empty() ? building.id : building.parent_id;
    const auto listed = index_of.find(root);
    // A parent without surfaces of its own may not be listed: its first part stands for it.
    roots[i] = listed != index_of.end()
                   ? listed->second
                   : root_of.emplace(root, static_cast<std::uint32_t>(i)).first->second;
  }
  return roots;
}

std::vector<char> ClosedBuildings(const CityModel& model, const TriangleEdges& edges) {
  const std::vector<std::uint32_t> roots = RootBuildings(model);
  std::vector<std::uint32_t> self(roots.size());
  for (std::size_t i = 0; i < self.size(); ++i) self[i] = static_cast<std::uint32_t>(i);
  std::vector<char> open(roots.size(), 0);
  std::vector<char> open_root(roots.size(), 0);
  MarkOpen(model, edges, self, open);
  MarkOpen(model, edges, roots, open_root);
  const std::vector<double> volume = Volumes(model, self);
  const std::vector<double> volume_root = Volumes(model, roots);
  std::vector<char> closed(roots.size());
  for (std::size_t i = 0; i < closed.size(); ++i) {
    closed[i] =
        (!open[i] && volume[i] > 0.0) || (!open_root[roots[i]] && volume_root[roots[i]] > 0);
  }
  return closed;
}

}  // namespace ridgeline
