// SPDX-License-Identifier: Apache-2.0
#include "localize/settle_pose.h"

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
  if (DistanceM(fit.offset, start.offset) > options.max_move_m ||
      AngleDeg(fit.offset, start.offset) > options.max_turn_deg) {
    return start;
  }
  const double log_ratio = scorer.LogRatioAt(fit.offset).value();  // a fit is admissible
  if (!(log_ratio >= start.log_ratio - options.max_loss)) return start;
  return {fit.offset, start.log_ratio};
}

}  // namespace ridgeline
