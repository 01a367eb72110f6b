// SPDX-License-Identifier: Apache-2.0
#include "city/mesh/shell_check.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <span>

#include "base/parallel.h"

namespace ridgeline {
namespace {

constexpr double kOpen = 0.002;  // share of the area that may stay unbalanced
constexpr double kDepth = 0.01;  // [m]: touching is not crossing

struct Corners {
  std::array<Eigen::Vector3d, 3> p;
  Eigen::AlignedBox3d box;
  Eigen::Vector3d normal;
};

Corners CornersOf(const CityModel& model, const Triangle& triangle) {
  Corners corners;
  for (std::size_t k = 0; k < 3; ++k) {
    corners.p[k] = model.vertices[triangle.vertices[k]];
    corners.box.extend(corners.p[k]);
  }
  corners.normal = (corners.p[1] - corners.p[0]).cross(corners.p[2] - corners.p[0]).normalized();
  return corners;
}

// Whether the segment goes through the triangle's inside, from clearly one side to clearly the
// other.
bool Pierces(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Corners& t) {
  const double height_a = t.normal.dot(a - t.p[0]);
  const double height_b = t.normal.dot(b - t.p[0]);
  if (std::min(height_a, height_b) > -kDepth || std::max(height_a, height_b) < kDepth) return false;
  const Eigen::Vector3d hit = a + height_a / (height_a - height_b) * (b - a);
  for (std::size_t k = 0; k < 3; ++k) {
    const Eigen::Vector3d edge = t.p[(k + 1) % 3] - t.p[k];
    // Distance from the side, inwards.
    if (t.normal.cross(edge).normalized().dot(hit - t.p[k]) < kDepth) return false;
  }
  return true;
}

bool CrossesItself(const CityModel& model, std::span<const std::uint32_t> triangles) {
  std::vector<Corners> corners;
  corners.reserve(triangles.size());
  for (const std::uint32_t t : triangles) corners.push_back(CornersOf(model, model.triangles[t]));
  std::vector<std::size_t> order(corners.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  // A sweep along east: only triangles whose ranges overlap are compared.
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return corners[a].box.min().x() < corners[b].box.min().x();
  });
  for (std::size_t i = 0; i < order.size(); ++i) {
    const Corners& a = corners[order[i]];
    for (std::size_t j = i + 1; j < order.size(); ++j) {
      const Corners& b = corners[order[j]];
      if (b.box.min().x() > a.box.max().x()) break;
      if (!a.box.intersects(b.box)) continue;
      for (std::size_t k = 0; k < 3; ++k) {
        if (Pierces(a.p[k], a.p[(k + 1) % 3], b) || Pierces(b.p[k], b.p[(k + 1) % 3], a))
          return true;
      }
    }
  }
  return false;
}

}  // namespace

std::vector<std::uint32_t> FindOpenShells(const CityModel& model) {
  std::vector<Eigen::Vector3d> balance(model.buildings.size(), Eigen::Vector3d::Zero());
  std::vector<double> area(model.buildings.size(), 0.0);
  for (const Triangle& t : model.triangles) {
    const Eigen::Vector3d& a = model.vertices[t.vertices[0]];
    const Eigen::Vector3d cross =
        (model.vertices[t.vertices[1]] - a).cross(model.vertices[t.vertices[2]] - a);
    const std::uint32_t b = model.surfaces[t.surface].building;
    balance[b] += cross;
    area[b] += cross.norm();
  }
  std::vector<std::uint32_t> open;
  for (std::uint32_t b = 0; b < balance.size(); ++b) {
    if (balance[b].norm() > kOpen * area[b]) open.push_back(b);
  }
  return open;
}

std::vector<std::uint32_t> FindCrossingShells(const CityModel& model, int threads) {
  std::vector<std::vector<std::uint32_t>> triangles(model.buildings.size());
  for (std::uint32_t t = 0; t < model.triangles.size(); ++t) {
    triangles[model.surfaces[model.triangles[t].surface].building].push_back(t);
  }
  std::vector<char> crosses(model.buildings.size(), 0);
  ParallelFor(model.buildings.size(), threads, [&](std::size_t b) {
    crosses[b] = CrossesItself(model, triangles[b]) ? 1 : 0;
  });
  std::vector<std::uint32_t> found;
  for (std::uint32_t b = 0; b < crosses.size(); ++b) {
    if (crosses[b] != 0) found.push_back(b);
  }
  return found;
}

}  // namespace ridgeline
