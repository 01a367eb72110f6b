// SPDX-License-Identifier: Apache-2.0
#include "localize/edge_matches.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <string>

namespace ridgeline {
namespace {

constexpr float kDegPerRad = 180.0f / std::numbers::pi_v<float>;
constexpr double kMaxAngleDeg = 15.0;  // at any tolerance: beyond, every line is a candidate

float UndirectedDeg(const Eigen::Vector2f& d) {
  const float angle = std::atan2(d.y(), d.x()) * kDegPerRad;
  return angle < 0.0f ? angle + 180.0f : (angle >= 180.0f ? angle - 180.0f : angle);
}

struct Interval {
  float first = 0.0f;
  float last = 0.0f;
};

// Whether more than half of the interval is taken by others.
bool IsTaken(const std::vector<Interval>& taken, const Interval& interval) {
  float covered = 0.0f;
  for (const Interval& other : taken) {
    covered += std::max(
        0.0f, std::min(interval.last, other.last) - std::max(interval.first, other.first));
  }
  return covered > 0.5f * (interval.last - interval.first);
}

// A line beside a projected edge, over a stretch of both.
struct Candidate {
  std::uint32_t segment = 0;
  std::uint32_t line = 0;
  Interval on_segment;  // [px] from its end a
  Interval on_line;
  float deviation = 0.0f;  // squared, in units of the standard deviation, both ends
};

double SigmaPx(double inverse_depth, double detection_px, double model_px_m) {
  return std::hypot(detection_px, model_px_m * inverse_depth);
}

// Of the variance of the mean of `count` observations by a part that they have in common.
double Inflation(double count, double common) { return 1.0 + std::max(0.0, count - 1.0) * common; }

// Edges that share an error of the model: the corners of a building (its place), and its other
// edges (their heights).
std::uint64_t GroupOf(const FeatureEdge& edge, const CityModel& model) {
  const std::uint32_t surface = edge.surface0 != kNoSurface ? edge.surface0 : edge.surface1;
  const std::uint64_t building = surface != kNoSurface ? model.surfaces[surface].building : 0;
  const Eigen::Vector3d d = edge.b - edge.a;
  const bool is_corner = std::abs(d.z()) > d.head<2>().norm();
  return 2 * building + (is_corner ? 1 : 0);
}

}  // namespace

Eigen::Vector3d OverhangOf(const FeatureEdge& edge, const CityModel& model) {
  if (edge.surface0 == kNoSurface || edge.surface1 == kNoSurface) return Eigen::Vector3d::Zero();
  const Surface* wall = &model.surfaces[edge.surface0];
  const Surface* roof = &model.surfaces[edge.surface1];
  if (wall->surface_class == SurfaceClass::kRoof) std::swap(wall, roof);
  if (wall->surface_class != SurfaceClass::kWall || roof->surface_class != SurfaceClass::kRoof) {
    return Eigen::Vector3d::Zero();
  }
  constexpr float kSteep = 0.1f;  // a plane within about 6 degrees of the vertical is no roof
  const Eigen::Vector2f outward = wall->normal.head<2>();
  if (roof->normal.z() < kSteep || outward.norm() < kSteep) return Eigen::Vector3d::Zero();
  const Eigen::Vector2f out = outward.normalized();
  return Eigen::Vector3f(
             out.x(), out.y(), -roof->normal.head<2>().dot(out) / roof->normal.z())
      .cast<double>();
}

EdgeMatcher::EdgeMatcher(std::span<const LineSegment> segments,
                         const OrientedDistanceField& field,
                         const Scene& scene,
                         const LineLikelihoodOptions& likelihood,
                         const EdgeMatchOptions& options)
    : segments_(segments),
      field_(field),
      scene_(scene),
      likelihood_(likelihood),
      options_(options) {
  for (std::uint32_t i = 0; i < segments.size(); ++i) {
    if (segments[i].Length() > 0.0f) {
      lines_.push_back({UndirectedDeg(segments[i].b - segments[i].a), i});
    }
  }
  std::stable_sort(lines_.begin(), lines_.end(),
                   [](const Line& x, const Line& y) { return x.angle_deg < y.angle_deg; });
}

std::vector<EdgeMatch> EdgeMatcher::Match(const PositionView& view,
                                          const PinholeCamera& camera,
                                          const Pose& cam_from_local,
                                          double tolerance,
                                          double overhang_m) const {
  VisibleSet moved;
  const VisibleSet* visible = &view.visible;
  if (overhang_m != 0.0) {
    moved = view.visible;
    for (VisiblePiece& piece : moved.pieces) {
      const Eigen::Vector3f shift =
          (overhang_m * OverhangOf(scene_.edge(piece.edge), scene_.model())).cast<float>();
      piece.a += shift;
      piece.b += shift;
    }
    visible = &moved;
  }
  std::vector<ProjectedSegment> projected;
  ProjectPieces(*visible, camera, cam_from_local, projected);

  const double detection_px = tolerance * likelihood_.sigma_width * camera.width;
  const double model_px_m = tolerance * likelihood_.sigma_model_m * camera.fx;
  const auto max_angle_deg =
      static_cast<float>(std::min(kMaxAngleDeg, tolerance * options_.max_angle_deg));
  const auto min_overlap_px = static_cast<float>(options_.min_overlap_width * camera.width);
  const auto limit = static_cast<float>(options_.max_sigmas);

  std::vector<Candidate> candidates;
  for (std::uint32_t s = 0; s < projected.size(); ++s) {
    const ProjectedSegment& segment = projected[s];
    const Eigen::Vector2f d = segment.b - segment.a;
    const float length = d.norm();
    if (length < min_overlap_px) continue;
    const Eigen::Vector2f along = d / length;
    const float angle = UndirectedDeg(d);
    const auto sigma_at = [&](float t) {
      const float w = segment.inverse_depth_a +
                      t / length * (segment.inverse_depth_b - segment.inverse_depth_a);
      return static_cast<float>(SigmaPx(w, detection_px, model_px_m));
    };
    const float widest = limit * std::max(sigma_at(0.0f), sigma_at(length));
    const auto consider = [&](const Line& line) {
      const LineSegment& seen = segments_[line.index];
      const Eigen::Vector2f a = seen.a - segment.a;
      const Eigen::Vector2f b = seen.b - segment.a;
      const float across_a = along.x() * a.y() - along.y() * a.x();
      const float across_b = along.x() * b.y() - along.y() * b.x();
      if (std::min(std::abs(across_a), std::abs(across_b)) > widest &&
          across_a * across_b > 0.0f) {
        return;
      }
      const float t_a = along.dot(a);
      const float t_b = along.dot(b);
      const Interval on_segment{std::max(0.0f, std::min(t_a, t_b)),
                                std::min(length, std::max(t_a, t_b))};
      if (on_segment.last - on_segment.first < min_overlap_px) return;
      // Along the line, in the same direction as its own.
      const auto at = [&](float t) { return (t - t_a) / (t_b - t_a); };
      const auto across = [&](float t) { return across_a + at(t) * (across_b - across_a); };
      const float first = across(on_segment.first) / sigma_at(on_segment.first);
      const float last = across(on_segment.last) / sigma_at(on_segment.last);
      if (std::max(std::abs(first), std::abs(last)) > limit) return;
      const float u = at(on_segment.first) * seen.Length();
      const float w = at(on_segment.last) * seen.Length();
      candidates.push_back({s,
                            line.index,
                            on_segment,
                            {std::min(u, w), std::max(u, w)},
                            first * first + last * last});
    };
    const auto consider_angles = [&](float lower, float upper) {
      const auto from = std::lower_bound(
          lines_.begin(), lines_.end(), lower,
          [](const Line& line, float value) { return line.angle_deg < value; });
      for (auto it = from; it != lines_.end() && it->angle_deg <= upper; ++it) consider(*it);
    };
    consider_angles(angle - max_angle_deg, angle + max_angle_deg);
    if (angle < max_angle_deg) consider_angles(angle - max_angle_deg + 180.0f, 180.0f);
    if (angle + max_angle_deg > 180.0f) consider_angles(0.0f, angle + max_angle_deg - 180.0f);
  }
  std::stable_sort(candidates.begin(), candidates.end(), [](const Candidate& x, const Candidate& y) {
    return x.deviation < y.deviation;
  });

  const Eigen::Quaterniond local_from_cam = cam_from_local.cam_from_world.conjugate();
  std::vector<std::vector<Interval>> taken_of_segment(projected.size());
  std::vector<std::vector<Interval>> taken_of_line(segments_.size());
  std::map<std::uint32_t, double> count_of_edge;
  std::map<std::uint64_t, double> count_of_group;
  std::vector<EdgeMatch> matches;
  for (const Candidate& candidate : candidates) {
    std::vector<Interval>& segment_intervals = taken_of_segment[candidate.segment];
    std::vector<Interval>& line_intervals = taken_of_line[candidate.line];
    if (IsTaken(segment_intervals, candidate.on_segment) ||
        IsTaken(line_intervals, candidate.on_line)) {
      continue;
    }
    segment_intervals.push_back(candidate.on_segment);
    line_intervals.push_back(candidate.on_line);

    const ProjectedSegment& segment = projected[candidate.segment];
    const VisiblePiece& piece = view.visible.pieces[segment.piece];
    const LineSegment& line = segments_[candidate.line];
    const Eigen::Vector2f d = segment.b - segment.a;
    const double length = d.norm();
    EdgeMatch match;
    match.edge = piece.edge;
    match.line = candidate.line;
    match.overhang = OverhangOf(scene_.edge(piece.edge), scene_.model());
    const auto place = [&](double t, Eigen::Vector3d& point, double& sigma_px) {
      const double w = segment.inverse_depth_a +
                       t * (static_cast<double>(segment.inverse_depth_b) - segment.inverse_depth_a);
      const Eigen::Vector2d px = segment.a.cast<double>() + t * d.cast<double>();
      point = cam_from_local.center_in_world + local_from_cam * (camera.RayFromImage(px) / w) -
              overhang_m * match.overhang;
      sigma_px = SigmaPx(w, detection_px, model_px_m);
    };
    place(candidate.on_segment.first / length, match.a, match.sigma_a_px);
    place(candidate.on_segment.last / length, match.b, match.sigma_b_px);
    const Eigen::Vector2d line_direction = (line.b - line.a).cast<double>().normalized();
    match.normal = {-line_direction.y(), line_direction.x()};
    match.offset_px = match.normal.dot(0.5 * (line.a + line.b).cast<double>());

    const double seen = likelihood_.seen_share[static_cast<std::size_t>(view.kinds[segment.piece])];
    const Eigen::Vector2f middle = 0.5f * (segment.a + segment.b);
    const int density_level =
        field_.DensityLevel(OrientedDistanceField::DirectionOf(d.x(), d.y()),
                            std::clamp(static_cast<int>(middle.x()), 0, field_.width() - 1),
                            std::clamp(static_cast<int>(middle.y()), 0, field_.height() - 1));
    if (density_level == OrientedDistanceField::kHiddenLevel) continue;
    const double density = OrientedDistanceField::DensityOfLevel(density_level);
    const double sigma_px = 0.5 * (match.sigma_a_px + match.sigma_b_px);
    match.odds = seen / (1.0 - seen) * std::sqrt(2.0 / std::numbers::pi) / sigma_px /
                 (2.0 * density);
    const bool is_parallel = d.cast<double>().dot(line_direction) > 0.0;
    const bool is_dark_sky = is_parallel ? piece.left == Beside::kSky : piece.right == Beside::kSky;
    if (is_dark_sky) match.odds *= options_.dark_sky_factor;
    match.weight = std::min(1.0,
                            (candidate.on_segment.last - candidate.on_segment.first) /
                                (options_.full_overlap_width * camera.width));
    match.group = GroupOf(scene_.edge(piece.edge), scene_.model());
    count_of_edge[match.edge] += match.weight;
    matches.push_back(match);
  }
  for (EdgeMatch& match : matches) {
    const double sigma_px = 0.5 * (match.sigma_a_px + match.sigma_b_px);
    match.common = std::max(0.0, 1.0 - detection_px * detection_px / (sigma_px * sigma_px));
    match.weight /= Inflation(count_of_edge[match.edge], match.common);
    count_of_group[match.group] += match.weight;
  }
  for (EdgeMatch& match : matches) {
    match.information = match.weight / Inflation(count_of_group[match.group], match.common);
  }
  return matches;
}

}  // namespace ridgeline
