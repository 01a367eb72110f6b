// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "localize/fit_pose.h"
#include "localize/pose_scorer.h"

namespace ridgeline {

// The least squares fit of a pose that the score has refined: what the score counts in steps the
// fit places between them. Kept only if the score agrees (its log ratio falls by less than
// `options.max_loss`) and the pose stays within `options.max_move_m` and `max_turn_deg`; else the
// start comes back. The log ratio stays that of the start, so that modes compare as before.
ScoredPose SettlePose(const PoseScorer& scorer,
                      const PictureLines& lines,
                      const LineLikelihoodOptions& likelihood,
                      const PoseFitOptions& options,
                      const ScoredPose& start);

}  // namespace ridgeline
