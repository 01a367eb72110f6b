// SPDX-License-Identifier: Apache-2.0
#include "localize/refine_pose.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace ridgeline {
namespace {

constexpr std::array<double PoseSpace::Offset::*, 3> kAngles = {
    &PoseSpace::Offset::heading_deg, &PoseSpace::Offset::pitch_deg, &PoseSpace::Offset::roll_deg};
constexpr std::array<double PoseSpace::Offset::*, 3> kPlace = {
    &PoseSpace::Offset::east_m, &PoseSpace::Offset::north_m, &PoseSpace::Offset::height_m};

// Of the angles around those for which a view was made.
constexpr double kMarginDeg = 3.0;
// A view serves for places this near, as a share of the distance to the nearest edge.
constexpr double kReach = 0.01;

class Climber {
 public:
  explicit Climber(const PoseScorer& scorer)
      : scorer_(scorer),
        space_(scorer.space()),
        place_ranges_{space_.ranges().east_m, space_.ranges().north_m, space_.ranges().height_m},
        angle_ranges_{
            space_.ranges().heading_deg, space_.ranges().pitch_deg, space_.ranges().roll_deg},
        look_(scorer) {}

  RefinedPose Climb(const ScoredPose& start, const RefineSteps& steps) {
    ScoredPose best = start;
    double angle_step = steps.first_deg;
    AtPlace(best, angle_step);
    for (double step = steps.first_m; step >= steps.last_m; step *= 0.5, angle_step *= 0.5) {
      for (bool moved = true; moved;) {
        moved = false;
        for (std::size_t k = 0; k < kPlace.size(); ++k) {
          if (place_ranges_[k] > 0.0) moved = TryBothWays(best, k, step, angle_step) || moved;
        }
      }
    }
    return {best, evaluations_};
  }

 private:
  bool TryBothWays(ScoredPose& best, std::size_t k, double step, double angle_step) {
    for (const double sign : {1.0, -1.0}) {
      ScoredPose candidate = best;
      double& value = candidate.offset.*kPlace[k];
      value = std::clamp(value + sign * step, -place_ranges_[k], place_ranges_[k]);
      if (value == best.offset.*kPlace[k]) continue;
      if (!AtPlace(candidate, angle_step) || candidate.log_ratio <= best.log_ratio) continue;
      best = candidate;
      return true;
    }
    return false;
  }

  // Maximises the free angles at the pose's place; false if the place is not admissible.
  bool AtPlace(ScoredPose& pose, double step) {
    const PoseSpace::Offset& o = pose.offset;
    const auto position = space_.PositionAt(o.east_m, o.north_m, o.height_m);
    if (!position) return false;
    LookFrom(*position, o);
    const auto evaluate = [&](const PoseSpace::Offset& offset) {
      ++evaluations_;
      return look_.LogRatio(*position, offset);
    };
    pose.log_ratio = evaluate(pose.offset);
    for (double s = step; s >= 0.25 * step; s *= 0.5) {
      for (bool moved = true; moved;) {
        moved = false;
        for (std::size_t k = 0; k < kAngles.size(); ++k) {
          if (angle_ranges_[k] <= 0.0) continue;
          for (const double sign : {1.0, -1.0}) {
            PoseSpace::Offset candidate = pose.offset;
            double& value = candidate.*kAngles[k];
            value = std::clamp(value + sign * s, -angle_ranges_[k], angle_ranges_[k]);
            if (std::abs(value - view_angles_.*kAngles[k]) > kMarginDeg) continue;
            const double log_ratio = evaluate(candidate);
            if (log_ratio <= pose.log_ratio) continue;
            pose = {candidate, log_ratio};
            moved = true;
            break;
          }
        }
      }
    }
    return true;
  }

  // Brings look_ up to date for a place and the angles around those of `offset`.
  void LookFrom(const Eigen::Vector3d& position, const PoseSpace::Offset& offset) {
    const bool is_same = (position - view_position_).norm() <= view_reach_m_ &&
                         std::all_of(kAngles.begin(), kAngles.end(), [&](auto angle) {
                           return std::abs(offset.*angle - view_angles_.*angle) <= 0.5 * kMarginDeg;
                         });
    if (is_same) return;
    look_.From(position,
               scorer_.RangeAround(space_.AnglesAt(offset), {kMarginDeg, kMarginDeg, kMarginDeg}));
    view_position_ = position;
    view_angles_ = offset;
    double nearest = std::numeric_limits<double>::infinity();
    for (const VisiblePiece& piece : look_.view().visible.pieces) {
      const Eigen::Vector3d a = piece.a.cast<double>() - position;
      const Eigen::Vector3d ab = (piece.b - piece.a).cast<double>();
      const double t = std::clamp(-a.dot(ab) / ab.squaredNorm(), 0.0, 1.0);
      nearest = std::min(nearest, (a + t * ab).norm());
    }
    view_reach_m_ = std::isfinite(nearest) ? kReach * nearest : 0.0;
  }

  const PoseScorer& scorer_;
  const PoseSpace& space_;
  std::array<double, 3> place_ranges_;
  std::array<double, 3> angle_ranges_;
  PoseScorer::Look look_;
  Eigen::Vector3d view_position_ =
      Eigen::Vector3d::Constant(std::numeric_limits<double>::infinity());
  double view_reach_m_ = 0.0;
  PoseSpace::Offset view_angles_;
  std::uint64_t evaluations_ = 0;
};

}  // namespace

RefinedPose RefinePose(const PoseScorer& scorer,
                       const ScoredPose& start,
                       const RefineSteps& steps) {
  return Climber(scorer).Climb(start, steps);
}

}  // namespace ridgeline
