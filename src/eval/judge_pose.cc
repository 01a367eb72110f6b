// SPDX-License-Identifier: Apache-2.0
#include "eval/judge_pose.h"

#include <cmath>
#include <memory>

#include "base/error.h"
#include "localize/goodness.h"
#include "localize/pose_scorer.h"
#include "score/picture_evidence.h"
#include "score/score_table.h"

namespace ridgeline {
namespace {

// The space of that pose alone, wherever it is.
PoseSpace SpaceOf(const Localizer& localizer, const Pose& pose) {
  const ViewAngles view = ViewAnglesOf(pose.cam_from_world);
  const PosePrior prior{pose.center_in_world.head<2>(),
                        pose.center_in_world.z(),
                        view.heading_deg,
                        view.pitch_deg,
                        view.roll_deg};
  PoseSpaceOptions only;
  only.east_m = only.north_m = only.height_m = 0.0;
  only.heading_deg = only.pitch_deg = only.roll_deg = 0.0;
  only.free_space = false;
  return {prior, only, localizer.scene(), localizer.dtm(), localizer.footprints()};
}

void CheckSize(const LocalizationInput& input) {
  if (input.picture.cols == input.camera.width && input.picture.rows == input.camera.height) return;
  throw InputError(
      "",
      "image",
      std::to_string(input.picture.cols) + " x " + std::to_string(input.picture.rows),
      "the camera's " + std::to_string(input.camera.width) + " x " +
          std::to_string(input.camera.height));
}

}  // namespace

PoseJudgement JudgePose(const Localizer& localizer,
                        const LocalizationInput& input,
                        const Pose& pose,
                        int threads) {
  CheckSize(input);
  const LocalizerOptions& options = localizer.options();
  const PictureEvidence picture(UndistortImage(BgrOf(input.picture), input.camera),
                                input.camera.Pinhole(),
                                options.lines,
                                options.score.evidence,
                                threads,
                                input.lines);
  const std::unique_ptr<Score> score = MakeScore({picture, localizer.scene(), options.score});
  const PoseSpace space = SpaceOf(localizer, pose);
  const PoseScorer scorer(*score,
                          localizer.scene(),
                          space,
                          picture.camera(),
                          options.score.evidence.surface_step_deg);
  PoseJudgement judgement;
  judgement.reason = score->unusable();
  if (!judgement.reason.empty()) return judgement;
  const std::optional<double> log_ratio = scorer.LogRatioAt({});
  if (!log_ratio || !std::isfinite(*log_ratio)) {
    judgement.reason = "nothing of the model is in view";
    return judgement;
  }
  judgement.energy = Score::EnergyOf(*log_ratio);
  judgement.goodness = GoodnessOf(scorer, {});
  return judgement;
}

}  // namespace ridgeline
