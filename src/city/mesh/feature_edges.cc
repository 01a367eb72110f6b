// SPDX-License-Identifier: Apache-2.0
#include "city/mesh/feature_edges.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <atomic>
#include <cmath>
#include <numbers>
#include <optional>
#include <span>

#include "base/error.h"
#include "base/limits.h"
#include "base/parallel.h"
#include "city/mesh/edge_table.h"
#include "city/mesh/face_grid.h"
#include "city/mesh/fold.h"
#include "city/mesh/merge_edges.h"

namespace ridgeline {
namespace {

constexpr double kGridCell = 8.0;    // [m]
constexpr double kParallel = 0.087;  // sine of 5 degrees

struct Piece {
  double from = 0.0;  // along the edge [m]
  double to = 0.0;
  std::uint32_t surface0 = kNoSurface;
  std::uint32_t surface1 = kNoSurface;
  bool seam = false;
};

class EdgeFinder {
 public:
  EdgeFinder(const FaceSet& set,
             const std::vector<std::uint32_t>& roots,
             const FeatureEdgeOptions& options)
      : set_(set),
        roots_(roots),
        options_(options),
        min_fold_(options.min_dihedral_deg * std::numbers::pi / 180.0),
        table_(BuildEdgeTable(set)),
        grid_(set, kGridCell) {}

  std::vector<FeatureEdge> Run() {
    constexpr std::size_t kBlock = 512;
    const std::size_t blocks = (table_.edges.size() + kBlock - 1) / kBlock;
    std::vector<std::vector<FeatureEdge>> results(blocks);
    ParallelFor(blocks, options_.threads, [&](std::size_t block) {
      Workspace workspace;
      const std::size_t end = std::min(table_.edges.size(), (block + 1) * kBlock);
      for (std::size_t e = block * kBlock; e < end; ++e) {
        Evaluate(static_cast<std::uint32_t>(e), workspace, results[block]);
      }
    });
    std::vector<FeatureEdge> edges;
    for (const std::vector<FeatureEdge>& result : results) {
      edges.insert(edges.end(), result.begin(), result.end());
    }
    return MergeCollinear(set_, edges);
  }

 private:
  // A face other than the edge's own ones that the edge touches in [from, to].
  struct Contact {
    std::uint32_t face = 0;
    double from = 0.0;
    double to = 0.0;
  };

  struct Workspace {
    std::vector<std::uint32_t> candidates;
    std::vector<Contact> contacts;
    std::vector<double> cuts;
    std::vector<HalfPlane> half_planes;
    std::vector<Piece> pieces;
  };

  // The line of an edge with a frame across it, in which the angles of faces are measured.
  struct Line {
    Eigen::Vector3d start, direction, u, v;
    double length = 0.0;

    double AngleOf(const Eigen::Vector3d& across) const {
      return std::atan2(across.dot(v), across.dot(u));
    }
  };

  void Evaluate(std::uint32_t index, Workspace& w, std::vector<FeatureEdge>& out) const {
    const PolygonEdge& edge = table_.edges[index];
    const Line line = LineOf(edge);
    if (line.length < options_.adjoin_m) return;
    FindContacts(edge, line, w);
    const std::size_t corners = CornersOfContacts(w);
    Spend(corners);
    FindCuts(line, w);
    Spend(corners * w.cuts.size());
    w.pieces.clear();
    for (std::size_t i = 0; i + 1 < w.cuts.size(); ++i) {
      const double middle = 0.5 * (w.cuts[i] + w.cuts[i + 1]);
      if (!CollectHalfPlanes(index, line, middle, w)) continue;
      std::optional<Piece> piece = Judge(w.half_planes);
      if (!piece) continue;
      piece->from = w.cuts[i];
      piece->to = w.cuts[i + 1];
      w.pieces.push_back(*piece);
    }
    for (const Piece& piece : w.pieces) {
      FeatureEdge feature;
      feature.a = piece.from <= 0.0 ? line.start : line.start + piece.from * line.direction;
      feature.b =
          piece.to >= line.length ? set_.vertices[edge.b] : line.start + piece.to * line.direction;
      feature.surface0 = piece.surface0;
      feature.surface1 = piece.surface1;
      feature.seam = piece.seam;
      out.push_back(feature);
    }
  }

  Line LineOf(const PolygonEdge& edge) const {
    Line line;
    line.start = set_.vertices[edge.a];
    const Eigen::Vector3d along = set_.vertices[edge.b] - line.start;
    line.length = along.norm();
    line.direction =
        line.length > 0.0 ? Eigen::Vector3d(along / line.length) : Eigen::Vector3d::UnitX();
    line.u = line.direction.unitOrthogonal();
    line.v = line.direction.cross(line.u);
    return line;
  }

  std::size_t CornersOfContacts(const Workspace& w) const {
    std::size_t corners = 0;
    for (const Contact& contact : w.contacts) {
      const Face& face = set_.faces[contact.face];
      for (std::uint32_t r = 0; r < face.ring_count; ++r) {
        corners += set_.Ring(face.first_ring + r).size();
      }
    }
    return corners;
  }

  // Corners of faces that edges run along.
  void Spend(std::size_t corners) const {
    const std::size_t most = limits::kContacts + limits::kContactsPerEdge * table_.edges.size();
    if (spent_.fetch_add(corners, std::memory_order_relaxed) <= most) return;
    throw InputError("city model",
                     "limit",
                     "polygons that lie in each other, so that " +
                         std::to_string(table_.edges.size()) + " edges touch more than " +
                         std::to_string(most) + " corners",
                     "buildings of which each surface is there once");
  }

  bool IsOwn(const PolygonEdge& edge, std::uint32_t face) const {
    for (std::uint32_t i = 0; i < edge.use_count; ++i) {
      if (table_.uses[edge.first_use + i].face == face) return true;
    }
    return false;
  }

  void FindContacts(const PolygonEdge& edge, const Line& line, Workspace& w) const {
    w.contacts.clear();
    const double tolerance = options_.adjoin_m;
    Eigen::AlignedBox3d box(line.start);
    box.extend(set_.vertices[edge.b]);
    const Eigen::Vector3d margin = Eigen::Vector3d::Constant(tolerance);
    grid_.Query({box.min() - margin, box.max() + margin}, w.candidates);
    for (const std::uint32_t f : w.candidates) {
      if (IsOwn(edge, f)) continue;
      const Eigen::AlignedBox3d grown(grid_.box(f).min() - margin, grid_.box(f).max() + margin);
      double from = 0.0;
      double to = line.length;
      if (!ClipToBox(line, grown, from, to) || to - from < tolerance) continue;
      const Face& face = set_.faces[f];
      const auto height = [&](double t) {
        return std::abs(face.normal.dot(line.start + t * line.direction - face.centroid));
      };
      if (height(from) <= tolerance && height(to) <= tolerance) w.contacts.push_back({f, from, to});
    }
  }

  static bool ClipToBox(const Line& line,
                        const Eigen::AlignedBox3d& box,
                        double& from,
                        double& to) {
    for (int axis = 0; axis < 3; ++axis) {
      const double start = line.start[axis];
      const double slope = line.direction[axis];
      if (std::abs(slope) < 1e-12) {
        if (start < box.min()[axis] || start > box.max()[axis]) return false;
        continue;
      }
      const double t0 = (box.min()[axis] - start) / slope;
      const double t1 = (box.max()[axis] - start) / slope;
      from = std::max(from, std::min(t0, t1));
      to = std::min(to, std::max(t0, t1));
    }
    return from < to;
  }

  // Where the corners of touching faces lie on the line, and where their edges cross it.
  void FindCuts(const Line& line, Workspace& w) const {
    const double tolerance = options_.adjoin_m;
    w.cuts = {0.0, line.length};
    const auto add = [&](double t) {
      if (t > tolerance && t < line.length - tolerance) w.cuts.push_back(t);
    };
    for (const Contact& contact : w.contacts) {
      const Face& face = set_.faces[contact.face];
      const Eigen::Vector3d across = face.normal.cross(line.direction).normalized();
      for (std::uint32_t r = face.first_ring; r < face.first_ring + face.ring_count; ++r) {
        const std::span<const std::uint32_t> ring = set_.Ring(r);
        for (std::size_t i = 0; i < ring.size(); ++i) {
          const Eigen::Vector3d a = set_.vertices[ring[i]] - line.start;
          const Eigen::Vector3d b = set_.vertices[ring[(i + 1) % ring.size()]] - line.start;
          const double side_a = a.dot(across);
          const double side_b = b.dot(across);
          if (std::abs(side_a) <= tolerance) add(a.dot(line.direction));
          const bool crosses = (side_a > tolerance && side_b < -tolerance) ||
                               (side_a < -tolerance && side_b > tolerance);
          if (crosses) {
            const double s = side_a / (side_a - side_b);
            add((a + s * (b - a)).dot(line.direction));
          }
        }
      }
    }
    std::sort(w.cuts.begin(), w.cuts.end());
    const auto close = [&](double a, double b) { return b - a < tolerance; };
    w.cuts.erase(std::unique(w.cuts.begin(), w.cuts.end(), close), w.cuts.end());
    w.cuts.back() = line.length;
  }

  // The faces around the line at `t`. False if a piece of another edge, of lower index, is the
  // same.
  bool CollectHalfPlanes(std::uint32_t index, const Line& line, double t, Workspace& w) const {
    w.half_planes.clear();
    const PolygonEdge& edge = table_.edges[index];
    for (std::uint32_t i = 0; i < edge.use_count; ++i) {
      const EdgeUse& use = table_.uses[edge.first_use + i];
      AddHalfPlane(line, use.face, use.forward ? 1.0 : -1.0, w);
    }
    const Eigen::Vector3d middle = line.start + t * line.direction;
    for (const Contact& contact : w.contacts) {
      if (t < contact.from || t > contact.to) continue;
      const Face& face = set_.faces[contact.face];
      if (RepeatedBy(face, line, middle, index)) return false;
      // Just beside the line, but farther than the face may be shifted.
      const Eigen::Vector3d across = face.normal.cross(line.direction).normalized();
      const double step = 2.5 * options_.adjoin_m;
      if (Contains(face, middle + step * across)) AddHalfPlane(line, contact.face, 1.0, w);
      if (Contains(face, middle - step * across)) AddHalfPlane(line, contact.face, -1.0, w);
    }
    return true;
  }

  void AddHalfPlane(const Line& line, std::uint32_t face, double side, Workspace& w) const {
    const Eigen::Vector3d& normal = set_.faces[face].normal;
    // Counter-clockwise about the normal, the interior is left of the direction of travel.
    const Eigen::Vector3d across = side * normal.cross(line.direction);
    const Eigen::Vector3d turn = line.direction.cross(across);  // towards larger angles
    w.half_planes.push_back({face, line.AngleOf(across), turn.dot(normal) >= 0.0 ? 1.0 : -1.0});
  }

  bool RepeatedBy(const Face& face,
                  const Line& line,
                  const Eigen::Vector3d& middle,
                  std::uint32_t index) const {
    const double tolerance = options_.adjoin_m;
    for (std::uint32_t r = face.first_ring; r < face.first_ring + face.ring_count; ++r) {
      const std::span<const std::uint32_t> ring = set_.Ring(r);
      for (std::size_t i = 0; i < ring.size(); ++i) {
        if (table_.edge_of_corner[set_.rings[r].first + i] >= index) continue;
        const Eigen::Vector3d& a = set_.vertices[ring[i]];
        const Eigen::Vector3d along = set_.vertices[ring[(i + 1) % ring.size()]] - a;
        const double length = along.norm();
        if (length < tolerance) continue;
        const double s = (middle - a).dot(along) / length;
        if (s < 0.0 || s > length) continue;
        if ((middle - a - s / length * along).squaredNorm() > tolerance * tolerance) continue;
        if (along.cross(line.direction).norm() < kParallel * length) return true;
      }
    }
    return false;
  }

  // Even-odd test in the face's plane, along the axis of its largest normal component.
  bool Contains(const Face& face, const Eigen::Vector3d& point) const {
    int axis = 0;
    face.normal.cwiseAbs().maxCoeff(&axis);
    const int x = (axis + 1) % 3;
    const int y = (axis + 2) % 3;
    bool inside = false;
    for (std::uint32_t r = face.first_ring; r < face.first_ring + face.ring_count; ++r) {
      const std::span<const std::uint32_t> ring = set_.Ring(r);
      for (std::size_t i = 0; i < ring.size(); ++i) {
        const Eigen::Vector3d& a = set_.vertices[ring[i]];
        const Eigen::Vector3d& b = set_.vertices[ring[(i + 1) % ring.size()]];
        if ((a[y] > point[y]) == (b[y] > point[y])) continue;
        const double at = a[x] + (point[y] - a[y]) / (b[y] - a[y]) * (b[x] - a[x]);
        if (point[x] < at) inside = !inside;
      }
    }
    return inside;
  }

  bool AllOf(const std::vector<HalfPlane>& planes, SurfaceClass surface_class) const {
    return std::all_of(planes.begin(), planes.end(), [&](const HalfPlane& plane) {
      return set_.faces[plane.face].surface_class == surface_class;
    });
  }

  std::optional<Piece> Judge(std::vector<HalfPlane>& planes) const {
    const std::size_t met = planes.size();
    RemoveHidden(set_, planes);
    if (planes.empty() || AllOf(planes, SurfaceClass::kClosure) ||
        AllOf(planes, SurfaceClass::kGround)) {
      return std::nullopt;
    }
    // A border beside hidden faces: the neighbour goes on, a step of a few centimetres apart.
    if (planes.size() == 1) return Piece{0.0, 0.0, planes[0].face, kNoSurface, met > 2};
    const auto [first, second, fold] = SharpestFold(planes);
    const std::uint32_t f0 = std::min(planes[first].face, planes[second].face);
    const std::uint32_t f1 = std::max(planes[first].face, planes[second].face);
    if (fold >= min_fold_) return Piece{0.0, 0.0, f0, f1, false};
    if (IsSeam(f0, f1)) return Piece{0.0, 0.0, f0, f1, true};
    return std::nullopt;
  }

  bool IsSeam(std::uint32_t f0, std::uint32_t f1) const {
    const Face& a = set_.faces[f0];
    const Face& b = set_.faces[f1];
    const auto is_visible = [](SurfaceClass c) {
      return c == SurfaceClass::kWall || c == SurfaceClass::kRoof;
    };
    return roots_[a.building] != roots_[b.building] && a.surface_class == b.surface_class &&
           is_visible(a.surface_class);
  }

  const FaceSet& set_;
  const std::vector<std::uint32_t>& roots_;
  FeatureEdgeOptions options_;
  double min_fold_;
  EdgeTable table_;
  FaceGrid grid_;
  mutable std::atomic<std::size_t> spent_{0};
};

}  // namespace

std::vector<FeatureEdge> FindFeatureEdges(const FaceSet& set,
                                          const std::vector<std::uint32_t>& root_of_building,
                                          const FeatureEdgeOptions& options) {
  return EdgeFinder(set, root_of_building, options).Run();
}

}  // namespace ridgeline
