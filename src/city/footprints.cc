// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <set>
#include <utility>

#include "city/mesh/point_welder.h"
#include "city/terrain.h"

namespace ridgeline {
namespace {

constexpr double kCell = 8.0;          // [m], of the lookup grid
constexpr double kWeldXy = 0.01;       // [m], of outlines
constexpr double kMinRingArea = 0.05;  // [m²]

using Point = Eigen::Vector2d;
using EdgeKey = std::pair<std::uint32_t, std::uint32_t>;

double Cross(const Point& a, const Point& b, const Point& c) {
  return (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x());
}

struct Triangle2 {
  Point a, b, c;  // counter-clockwise
  bool Contains(const Point& p) const {
    return Cross(a, b, p) >= 0.0 && Cross(b, c, p) >= 0.0 && Cross(c, a, p) >= 0.0;
  }
};

// Chains directed edges into closed rings; at a corner where several go on, the one that turns most
// to the right, so that rings which touch in a point stay apart.
class RingChainer {
 public:
  explicit RingChainer(const std::vector<Eigen::Vector3d>& points) : points_(points) {}

  void Add(std::uint32_t from, std::uint32_t to) { next_[from].push_back(to); }

  std::vector<std::vector<Point>> Rings() {
    std::vector<std::vector<Point>> rings;
    for (auto& [start, targets] : next_) {
      while (!targets.empty()) {
        std::vector<std::uint32_t> ring = Walk(start);
        if (ring.size() < 3) continue;
        std::vector<Point> polygon;
        for (const std::uint32_t i : ring) polygon.push_back(points_[i].head<2>());
        rings.push_back(std::move(polygon));
      }
    }
    return rings;
  }

 private:
  // Takes edges from `start` until it is reached again; empty if the chain breaks off.
  std::vector<std::uint32_t> Walk(std::uint32_t start) {
    std::vector<std::uint32_t> ring{start};
    std::uint32_t previous = start;
    std::uint32_t current = Take(start, start);
    while (current != start) {
      ring.push_back(current);
      const auto it = next_.find(current);
      if (it == next_.end() || it->second.empty()) return {};
      const std::uint32_t following = Take(current, previous);
      previous = current;
      current = following;
    }
    return ring;
  }

  std::uint32_t Take(std::uint32_t at, std::uint32_t previous) {
    std::vector<std::uint32_t>& targets = next_[at];
    std::size_t best = 0;
    double best_turn = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < targets.size(); ++i) {
      const double turn = Turn(previous, at, targets[i]);
      if (turn < best_turn) {
        best_turn = turn;
        best = i;
      }
    }
    const std::uint32_t target = targets[best];
    targets.erase(targets.begin() + static_cast<std::ptrdiff_t>(best));
    return target;
  }

  // Left turn in (-pi, pi].
  double Turn(std::uint32_t a, std::uint32_t b, std::uint32_t c) const {
    const Point in = (points_[b] - points_[a]).head<2>();
    const Point out = (points_[c] - points_[b]).head<2>();
    return std::atan2(in.x() * out.y() - in.y() * out.x(), in.dot(out));
  }

  const std::vector<Eigen::Vector3d>& points_;
  std::map<std::uint32_t, std::vector<std::uint32_t>> next_;
};

double RingArea(const std::vector<Point>& ring) {
  double twice = 0.0;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Point& a = ring[i];
    const Point& b = ring[(i + 1) % ring.size()];
    twice += (a - ring.front()).x() * (b - ring.front()).y() -
             (a - ring.front()).y() * (b - ring.front()).x();
  }
  return 0.5 * twice;
}

}  // namespace

struct Footprints::Impl {
  std::vector<Triangle2> triangles;
  std::vector<std::vector<Point>> wall_outlines;  // of buildings that have nothing but walls
  std::vector<std::vector<Point>> rings;
  Point lower = Point::Zero();
  int columns = 0;
  int rows = 0;
  std::vector<std::vector<std::uint32_t>> triangles_of_cell;
  std::vector<std::vector<std::uint32_t>> outlines_of_cell;

  void AddCovered(const CityModel& model, const std::vector<std::uint32_t>& covered) {
    PointWelder welder(kWeldXy);
    std::map<EdgeKey, int> edges;
    for (const std::uint32_t t : covered) {
      std::array<std::uint32_t, 3> v{};
      for (std::size_t k = 0; k < 3; ++k) {
        Eigen::Vector3d p = model.vertices[model.triangles[t].vertices[k]];
        p.z() = 0.0;
        v[k] = welder.Add(p);
      }
      const auto point = [&](std::size_t k) -> Point { return welder.points()[v[k]].head<2>(); };
      const double area = Cross(point(0), point(1), point(2));
      if (v[0] == v[1] || v[1] == v[2] || v[2] == v[0] || area == 0.0) continue;
      if (area < 0.0) std::swap(v[1], v[2]);
      triangles.push_back({point(0), point(1), point(2)});
      for (std::size_t k = 0; k < 3; ++k) ++edges[{v[k], v[(k + 1) % 3]}];
    }
    RingChainer chainer(welder.points());
    for (const auto& [edge, count] : edges) {
      const auto opposite = edges.find({edge.second, edge.first});
      const int inner = opposite == edges.end() ? 0 : opposite->second;
      for (int i = inner; i < count; ++i) chainer.Add(edge.first, edge.second);
    }
    for (std::vector<Point>& ring : chainer.Rings()) {
      if (RingArea(ring) > kMinRingArea) rings.push_back(std::move(ring));
    }
  }

  // The outline that the walls of a building draw from above.
  void AddWallOutline(const CityModel& model, const std::vector<std::uint32_t>& walls) {
    PointWelder welder(kWeldXy);
    std::set<EdgeKey> edges;
    for (const std::uint32_t t : walls) {
      const Triangle& triangle = model.triangles[t];
      const Eigen::Vector3f& normal = model.surfaces[triangle.surface].normal;
      // Seen from outside, the outline runs to the right: interior on the left of the run.
      const Eigen::Vector3d along(-normal.y(), normal.x(), 0.0);
      const auto by_progress = [&](std::uint32_t a, std::uint32_t b) {
        return model.vertices[a].dot(along) < model.vertices[b].dot(along);
      };
      const auto [low, high] =
          std::minmax_element(triangle.vertices.begin(), triangle.vertices.end(), by_progress);
      Eigen::Vector3d from = model.vertices[*low];
      Eigen::Vector3d to = model.vertices[*high];
      from.z() = to.z() = 0.0;
      const std::uint32_t a = welder.Add(from);
      const std::uint32_t b = welder.Add(to);
      if (a != b) edges.insert({a, b});
    }
    RingChainer chainer(welder.points());
    for (const EdgeKey& edge : edges) chainer.Add(edge.first, edge.second);
    for (std::vector<Point>& ring : chainer.Rings()) {
      if (RingArea(ring) < kMinRingArea) continue;
      rings.push_back(ring);
      wall_outlines.push_back(std::move(ring));
    }
  }

  void BuildGrid() {
    Point upper = Point::Constant(-std::numeric_limits<double>::infinity());
    lower = -upper;
    for (const std::vector<Point>& ring : rings) {
      for (const Point& p : ring) {
        lower = lower.cwiseMin(p);
        upper = upper.cwiseMax(p);
      }
    }
    for (const Triangle2& t : triangles) {
      lower = lower.cwiseMin(t.a).cwiseMin(t.b).cwiseMin(t.c);
      upper = upper.cwiseMax(t.a).cwiseMax(t.b).cwiseMax(t.c);
    }
    if (!(lower.x() <= upper.x())) return;
    columns = static_cast<int>((upper.x() - lower.x()) / kCell) + 1;
    rows = static_cast<int>((upper.y() - lower.y()) / kCell) + 1;
    const auto cells = static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows);
    triangles_of_cell.resize(cells);
    outlines_of_cell.resize(cells);
    for (std::uint32_t i = 0; i < triangles.size(); ++i) {
      const Triangle2& t = triangles[i];
      Fill(t.a.cwiseMin(t.b).cwiseMin(t.c), t.a.cwiseMax(t.b).cwiseMax(t.c), i, triangles_of_cell);
    }
    for (std::uint32_t i = 0; i < wall_outlines.size(); ++i) {
      Point low = wall_outlines[i].front();
      Point high = low;
      for (const Point& p : wall_outlines[i]) {
        low = low.cwiseMin(p);
        high = high.cwiseMax(p);
      }
      Fill(low, high, i, outlines_of_cell);
    }
  }

  void Fill(const Point& low,
            const Point& high,
            std::uint32_t index,
            std::vector<std::vector<std::uint32_t>>& cells) const {
    const Eigen::Vector2i first = ((low - lower) / kCell).cast<int>();
    const Eigen::Vector2i last = ((high - lower) / kCell).cast<int>();
    for (int y = first.y(); y <= last.y(); ++y) {
      for (int x = first.x(); x <= last.x(); ++x) cells[CellIndex(x, y)].push_back(index);
    }
  }

  std::size_t CellIndex(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(columns) +
           static_cast<std::size_t>(x);
  }

  bool InOutline(const std::vector<Point>& ring, const Point& p) const {
    bool inside = false;
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const Point& a = ring[i];
      const Point& b = ring[(i + 1) % ring.size()];
      if ((a.y() > p.y()) == (b.y() > p.y())) continue;
      if (p.x() < a.x() + (p.y() - a.y()) / (b.y() - a.y()) * (b.x() - a.x())) inside = !inside;
    }
    return inside;
  }

  bool Contains(const Point& p) const {
    const Point cell = (p - lower) / kCell;
    if (!(cell.x() >= 0.0 && cell.y() >= 0.0 && cell.x() < columns && cell.y() < rows))
      return false;
    const std::size_t index = CellIndex(static_cast<int>(cell.x()), static_cast<int>(cell.y()));
    const auto in_triangle = [&](std::uint32_t t) { return triangles[t].Contains(p); };
    const auto in_outline = [&](std::uint32_t o) { return InOutline(wall_outlines[o], p); };
    return std::any_of(
               triangles_of_cell[index].begin(), triangles_of_cell[index].end(), in_triangle) ||
           std::any_of(outlines_of_cell[index].begin(), outlines_of_cell[index].end(), in_outline);
  }
};

Footprints::Footprints(const CityModel& model) : impl_(std::make_unique<Impl>()) {
  struct Parts {
    std::vector<std::uint32_t> ground, walls, roof;
  };
  std::vector<Parts> parts(model.buildings.size());
  for (std::uint32_t t = 0; t < model.triangles.size(); ++t) {
    const Surface& surface = model.surfaces[model.triangles[t].surface];
    Parts& of_building = parts[surface.building];
    if (surface.surface_class == SurfaceClass::kGround) of_building.ground.push_back(t);
    if (surface.surface_class == SurfaceClass::kWall) of_building.walls.push_back(t);
    if (surface.surface_class == SurfaceClass::kRoof) of_building.roof.push_back(t);
  }
  for (const Parts& of_building : parts) {
    if (!of_building.ground.empty()) {
      impl_->AddCovered(model, of_building.ground);
      continue;
    }
    const std::size_t outlines = impl_->wall_outlines.size();
    impl_->AddWallOutline(model, of_building.walls);
    // Walls that do not close: the roof says where the building is.
    if (impl_->wall_outlines.size() == outlines) impl_->AddCovered(model, of_building.roof);
  }
  impl_->BuildGrid();
}

Footprints::~Footprints() = default;
Footprints::Footprints(Footprints&&) noexcept = default;
Footprints& Footprints::operator=(Footprints&&) noexcept = default;

bool Footprints::Contains(const Eigen::Vector2d& xy) const { return impl_->Contains(xy); }

const std::vector<std::vector<Eigen::Vector2d>>& Footprints::rings() const { return impl_->rings; }

}  // namespace ridgeline
