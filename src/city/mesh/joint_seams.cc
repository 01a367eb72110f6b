// SPDX-License-Identifier: Apache-2.0
#include "city/mesh/joint_seams.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

#include "city/mesh/face_grid.h"

namespace ridgeline {
namespace {

constexpr double kUpright = 0.95;      // of an edge's direction
constexpr double kSameFacing = 0.985;  // 10 degrees between facades
constexpr double kBeyondJoint = 0.15;  // [m]: the neighbour must reach this far past the joint
constexpr double kSeamGridCell = 8.0;  // [m]

using Interval = std::pair<double, double>;

class JointMarker {
 public:
  JointMarker(const FaceSet& set, const std::vector<std::uint32_t>& roots, double joint_m)
      : set_(set), roots_(roots), joint_(joint_m), grid_(set, kSeamGridCell) {}

  void Run(std::vector<FeatureEdge>& edges) {
    std::vector<FeatureEdge> result;
    result.reserve(edges.size());
    for (const FeatureEdge& edge : edges) {
      if (IsCorner(edge)) {
        Split(edge, JointIntervals(edge), result);
      } else {
        result.push_back(edge);
      }
    }
    edges = std::move(result);
  }

 private:
  bool IsCorner(const FeatureEdge& edge) const {
    if (edge.seam || edge.surface1 == kNoSurface) return false;
    const bool walls = set_.faces[edge.surface0].surface_class == SurfaceClass::kWall &&
                       set_.faces[edge.surface1].surface_class == SurfaceClass::kWall;
    return walls && std::abs((edge.b - edge.a).normalized().z()) > kUpright;
  }

  // Along the edge [m]: where one of its two facades goes on in a neighbour's.
  std::vector<Interval> JointIntervals(const FeatureEdge& edge) {
    std::vector<Interval> intervals;
    const Eigen::Vector3d direction = (edge.b - edge.a).normalized();
    const double reach = joint_ + kBeyondJoint;
    Eigen::AlignedBox3d box(edge.a);
    box.extend(edge.b);
    const Eigen::Vector3d margin = Eigen::Vector3d::Constant(reach);
    grid_.Query({box.min() - margin, box.max() + margin}, candidates_);
    for (const std::uint32_t f : {edge.surface0, edge.surface1}) {
      const Face& facade = set_.faces[f];
      const Eigen::Vector3d away = AwayFrom(facade, edge, direction);
      for (const std::uint32_t g : candidates_) {
        const Face& other = set_.faces[g];
        if (other.surface_class != SurfaceClass::kWall ||
            roots_[other.building] == roots_[facade.building] ||
            other.normal.dot(facade.normal) < kSameFacing ||
            std::abs(other.normal.dot(edge.a - other.centroid)) > joint_) {
          continue;
        }
        AddInside(other, edge.a + reach * away, direction, (edge.b - edge.a).norm(), intervals);
      }
    }
    std::sort(intervals.begin(), intervals.end());
    return intervals;
  }

  // In the facade's plane, across the edge, from the facade outwards.
  Eigen::Vector3d AwayFrom(const Face& facade,
                           const FeatureEdge& edge,
                           const Eigen::Vector3d& direction) const {
    const Eigen::Vector3d across = facade.normal.cross(direction).normalized();
    const Eigen::Vector3d middle = 0.5 * (edge.a + edge.b);
    double weight = 0.0;
    for (const std::uint32_t v : set_.Ring(facade.first_ring)) {
      weight += (set_.vertices[v] - middle).dot(across);
    }
    return weight > 0.0 ? Eigen::Vector3d(-across) : across;
  }

  // The parts of the line within the face, seen along the face's normal.
  void AddInside(const Face& face,
                 const Eigen::Vector3d& start,
                 const Eigen::Vector3d& direction,
                 double length,
                 std::vector<Interval>& intervals) const {
    const Eigen::Vector3d across = face.normal.cross(direction).normalized();
    std::vector<double> crossings;
    for (std::uint32_t r = face.first_ring; r < face.first_ring + face.ring_count; ++r) {
      const std::span<const std::uint32_t> ring = set_.Ring(r);
      for (std::size_t i = 0; i < ring.size(); ++i) {
        const Eigen::Vector3d a = set_.vertices[ring[i]] - start;
        const Eigen::Vector3d b = set_.vertices[ring[(i + 1) % ring.size()]] - start;
        const double side_a = a.dot(across);
        const double side_b = b.dot(across);
        if ((side_a > 0.0) == (side_b > 0.0)) continue;
        crossings.push_back((a + side_a / (side_a - side_b) * (b - a)).dot(direction));
      }
    }
    std::sort(crossings.begin(), crossings.end());
    for (std::size_t i = 0; i + 1 < crossings.size(); i += 2) {
      const double from = std::max(crossings[i], 0.0);
      const double to = std::min(crossings[i + 1], length);
      if (to > from) intervals.emplace_back(from, to);
    }
  }

  // Puts the edge into `result`, cut into seams and the rest. Rests shorter than a joint is wide go
  // with the seam beside them.
  void Split(const FeatureEdge& edge,
             const std::vector<Interval>& intervals,
             std::vector<FeatureEdge>& result) const {
    const double length = (edge.b - edge.a).norm();
    std::vector<Interval> seams;
    for (Interval interval : intervals) {
      if (interval.first < joint_) interval.first = 0.0;
      if (interval.second > length - joint_) interval.second = length;
      if (!seams.empty() && interval.first <= seams.back().second + joint_) {
        seams.back().second = std::max(seams.back().second, interval.second);
      } else {
        seams.push_back(interval);
      }
    }
    const auto add = [&](double from, double to, bool seam) {
      if (to <= from) return;
      FeatureEdge piece = edge;
      const Eigen::Vector3d along = edge.b - edge.a;
      if (from > 0.0) piece.a = edge.a + from / length * along;
      if (to < length) piece.b = edge.a + to / length * along;
      piece.seam = seam;
      result.push_back(piece);
    };
    double done = 0.0;
    for (const Interval& seam : seams) {
      add(done, seam.first, false);
      add(seam.first, seam.second, true);
      done = seam.second;
    }
    add(done, length, false);
  }

  const FaceSet& set_;
  const std::vector<std::uint32_t>& roots_;
  double joint_;
  FaceGrid grid_;
  std::vector<std::uint32_t> candidates_;
};

}  // namespace

void MarkJointSeams(const FaceSet& set,
                    const std::vector<std::uint32_t>& root_of_building,
                    double joint_m,
                    std::vector<FeatureEdge>& edges) {
  if (joint_m <= 0.0) return;
  JointMarker(set, root_of_building, joint_m).Run(edges);
}

}  // namespace ridgeline
