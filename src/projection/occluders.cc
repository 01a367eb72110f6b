// SPDX-License-Identifier: Apache-2.0
#include "projection/occluders.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <optional>

namespace ridgeline {
namespace {

// Corners of one plane lie within this of it [m].
constexpr double kPlanar = 2e-4;

using Quadrangle = std::array<std::uint32_t, 4>;

bool IsPlaneAndConvex(const CityModel& model, const Quadrangle& corners) {
  std::array<Eigen::Vector3d, 4> p;
  for (int k = 0; k < 4; ++k) p[k] = model.vertices[corners[k]];
  const Eigen::Vector3d normal = (p[2] - p[0]).cross(p[3] - p[1]);
  const double length = normal.norm();
  if (length < 1e-6) return false;
  for (int k = 0; k < 4; ++k) {
    const Eigen::Vector3d side = p[(k + 1) % 4] - p[k];
    const Eigen::Vector3d next = p[(k + 2) % 4] - p[(k + 1) % 4];
    if (side.cross(next).dot(normal) <= 0.0) return false;
    if (std::abs(normal.dot(p[k] - p[0])) > kPlanar * length) return false;
  }
  return true;
}

// The quadrangle of the two triangles at an edge inside one surface.
std::optional<Quadrangle> QuadrangleAt(const CityModel& model,
                                       const TriangleEdges& mesh,
                                       const TriangleEdge& edge) {
  if (edge.count != 2) return std::nullopt;
  const TriangleSide& side0 = mesh.sides[edge.first];
  const TriangleSide& side1 = mesh.sides[edge.first + 1];
  if (side0.forward == side1.forward ||
      model.triangles[side0.triangle].surface != model.triangles[side1.triangle].surface) {
    return std::nullopt;
  }
  const Quadrangle corners = side0.forward
                                 ? Quadrangle{edge.v1, side0.opposite, edge.v0, side1.opposite}
                                 : Quadrangle{edge.v0, side0.opposite, edge.v1, side1.opposite};
  if (!IsPlaneAndConvex(model, corners)) return std::nullopt;
  return corners;
}

}  // namespace

std::vector<Occluder> ModelOccluders(const CityModel& model,
                                     const TriangleEdges& mesh,
                                     double tolerance_m) {
  const auto tolerance = static_cast<float>(tolerance_m);
  const auto vertex = [&](std::uint32_t i) -> Eigen::Vector3f {
    return model.vertices[i].cast<float>();
  };
  // Long edges first: they are the diagonals.
  std::vector<std::pair<double, const TriangleEdge*>> edges;
  for (const TriangleEdge& edge : mesh.edges) {
    edges.emplace_back((model.vertices[edge.v0] - model.vertices[edge.v1]).squaredNorm(), &edge);
  }
  std::stable_sort(
      edges.begin(), edges.end(), [](const auto& p, const auto& q) { return p.first > q.first; });
  std::vector<Occluder> occluders;
  std::vector<char> is_used(model.triangles.size(), 0);
  for (const auto& [length, edge] : edges) {
    if (edge->count != 2) continue;
    char& used0 = is_used[mesh.sides[edge->first].triangle];
    char& used1 = is_used[mesh.sides[edge->first + 1].triangle];
    if (used0 || used1) continue;
    const std::optional<Quadrangle> q = QuadrangleAt(model, mesh, *edge);
    if (!q) continue;
    used0 = used1 = 1;
    occluders.push_back(
        {vertex((*q)[0]), vertex((*q)[1]), vertex((*q)[2]), vertex((*q)[3]), tolerance});
  }
  for (std::size_t i = 0; i < model.triangles.size(); ++i) {
    if (is_used[i]) continue;
    const auto& v = model.triangles[i].vertices;
    occluders.push_back({vertex(v[0]), vertex(v[1]), vertex(v[2]), vertex(v[2]), tolerance});
  }
  return occluders;
}

std::vector<Occluder> TerrainOccluders(const TerrainMesh& terrain, double lowered_by_m) {
  std::vector<Occluder> occluders;
  occluders.reserve(terrain.triangles.size());
  const Eigen::Vector3f lowered(0.0f, 0.0f, static_cast<float>(lowered_by_m));
  for (const auto& v : terrain.triangles) {
    const Eigen::Vector3f c = terrain.vertices[v[2]] - lowered;
    occluders.push_back(
        {terrain.vertices[v[0]] - lowered, terrain.vertices[v[1]] - lowered, c, c, 0.0f});
  }
  return occluders;
}

}  // namespace ridgeline
