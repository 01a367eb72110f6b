// SPDX-License-Identifier: Apache-2.0
#include "localize/settle_pose.h"

#include <cmath>

namespace ridgeline {

ScoredPose SettlePose(const PoseScorer& scorer,
                      const PictureLines& lines,
                      const LineLikelihoodOptions& likelihood,
                      const PoseFitOptions& options,
                      const ScoredPose& start) {
  PoseFitOptions near = options;
  near.first_tolerance = 1.0;  // the score has brought it home
  const PoseFit fit =
      FitPose(lines, scorer.scene(), scorer.space(), likelihood, near, start.offset);
  if (fit.status == PoseFitStatus::kNoMatches || fit.status == PoseFitStatus::kNotAdmissible) {
    return start;
  }
  const PoseSpace::Offset& from = start.offset;
  const PoseSpace::Offset& to = fit.offset;
  const double move_m =
      Eigen::Vector3d(
          to.east_m - from.east_m, to.north_m - from.north_m, to.height_m - from.height_m)
          .norm();
  const double turn_deg = Eigen::Vector3d(HeadingDifferenceDeg(to.heading_deg, from.heading_deg),
                                          to.pitch_deg - from.pitch_deg,
                                          to.roll_deg - from.roll_deg)
                              .norm();
  if (move_m > options.max_move_m || turn_deg > options.max_turn_deg) return start;
  const double log_ratio = scorer.LogRatioAt(to).value();  // a fit is admissible
  if (!(log_ratio >= start.log_ratio - options.max_loss)) return start;
  return {to, start.log_ratio};
}

}  // namespace ridgeline
