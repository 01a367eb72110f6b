// SPDX-License-Identifier: Apache-2.0
#include "projection/terrain_mesh.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <string>

#include "base/error.h"

namespace ridgeline {
namespace {

struct Point {
  int x = 0;
  int y = 0;
};

Point Middle(Point a, Point b) { return {(a.x + b.x) / 2, (a.y + b.y) / 2}; }

// The hierarchy of right triangles over a square of 2^k cells that covers the grid.
class TriangleHierarchy {
 public:
  explicit TriangleHierarchy(const HeightGrid& grid) : grid_(grid) {
    while (cells_ < std::max(grid.columns, grid.rows) - 1) cells_ *= 2;
    errors_.assign(static_cast<std::size_t>(cells_ + 1) * static_cast<std::size_t>(cells_ + 1), 0);
    // Children have larger numbers than their parents, so that one sweep backwards is enough.
    const std::int64_t count = 2 * static_cast<std::int64_t>(cells_) * cells_ - 2;
    const std::int64_t parents = count - static_cast<std::int64_t>(cells_) * cells_;
    for (std::int64_t i = count - 1; i >= 0; --i) AddError(i + 2, i < parents);
  }

  TerrainMesh Mesh(float max_error) {
    max_error_ = max_error;
    vertex_of_.assign(errors_.size(), -1);
    Split({0, 0}, {cells_, cells_}, {cells_, 0});
    Split({cells_, cells_}, {0, 0}, {0, cells_});
    return std::move(mesh_);
  }

 private:
  float Height(Point p) const {
    if (p.x >= grid_.columns || p.y >= grid_.rows) return std::numeric_limits<float>::quiet_NaN();
    return grid_.heights[static_cast<std::size_t>(p.y) * static_cast<std::size_t>(grid_.columns) +
                         static_cast<std::size_t>(p.x)];
  }

  std::size_t Index(Point p) const {
    return static_cast<std::size_t>(p.y) * static_cast<std::size_t>(cells_ + 1) +
           static_cast<std::size_t>(p.x);
  }

  // Triangle number `id`: its bits tell the way down from the two roots, 2 and 3.
  void AddError(std::int64_t id, bool has_children) {
    Point a, b, c;
    if (id & 1) {
      b = {cells_, cells_};
      c = {cells_, 0};
    } else {
      a = {cells_, cells_};
      c = {0, cells_};
    }
    while ((id >>= 1) > 1) {
      const Point m = Middle(a, b);
      if (id & 1) {
        b = a;
        a = c;
      } else {
        a = b;
        b = c;
      }
      c = m;
    }
    const Point m = Middle(a, b);
    // The corner at the right angle.
    const Point right{m.x + m.y - a.y, m.y + a.x - m.x};
    float error = MiddleError(Height(a), Height(b), Height(m));
    if (has_children) {
      error = std::max({error, errors_[Index(Middle(a, right))], errors_[Index(Middle(b, right))]});
    }
    errors_[Index(m)] = std::max(errors_[Index(m)], error);
  }

  // Infinite where known and unknown heights meet: split to the border.
  static float MiddleError(float a, float b, float middle) {
    const int unknown = std::isnan(a) + std::isnan(b) + std::isnan(middle);
    if (unknown == 3) return 0.0f;
    if (unknown > 0) return std::numeric_limits<float>::infinity();
    return std::abs((a + b) / 2 - middle);
  }

  void Split(Point a, Point b, Point c) {
    const Point m = Middle(a, b);
    if (std::abs(a.x - c.x) + std::abs(a.y - c.y) > 1 && errors_[Index(m)] > max_error_) {
      Split(c, a, m);
      Split(b, c, m);
      return;
    }
    if (std::isnan(Height(a)) || std::isnan(Height(b)) || std::isnan(Height(c))) return;
    // The roots go clockwise with y to the north.
    mesh_.triangles.push_back({Vertex(a), Vertex(c), Vertex(b)});
  }

  std::uint32_t Vertex(Point p) {
    std::int32_t& vertex = vertex_of_[Index(p)];
    if (vertex < 0) {
      vertex = static_cast<std::int32_t>(mesh_.vertices.size());
      mesh_.vertices.emplace_back(static_cast<float>(grid_.first.x() + p.x * grid_.spacing_m),
                                  static_cast<float>(grid_.first.y() + p.y * grid_.spacing_m),
                                  Height(p));
    }
    return static_cast<std::uint32_t>(vertex);
  }

  const HeightGrid& grid_;
  int cells_ = 1;
  std::vector<float> errors_;
  float max_error_ = 0.0f;
  std::vector<std::int32_t> vertex_of_;
  TerrainMesh mesh_;
};

}  // namespace

TerrainMesh MeshTerrain(const HeightGrid& grid, double max_error_m) {
  const auto expected = static_cast<std::int64_t>(grid.columns) * grid.rows;
  if (grid.columns < 0 || grid.rows < 0 ||
      expected != static_cast<std::int64_t>(grid.heights.size())) {
    throw InputError("DTM",
                     "heights",
                     std::to_string(grid.heights.size()) + " values",
                     std::to_string(grid.columns) + " x " + std::to_string(grid.rows));
  }
  if (grid.columns < 2 || grid.rows < 2) return {};
  return TriangleHierarchy(grid).Mesh(static_cast<float>(max_error_m));
}

}  // namespace ridgeline
