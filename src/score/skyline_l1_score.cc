// SPDX-License-Identifier: Apache-2.0
#include "score/skyline_l1_score.h"

namespace ridgeline {

double SkylineL1Score::LogRatio(const PositionView& view,
                                const Pose& cam_from_local,
                                PictureEvidence::Workspace& /*workspace*/) const {
  const Eigen::Matrix3f rotation = cam_from_local.cam_from_world.toRotationMatrix().cast<float>();
  return LogRatioOf(matcher_.Energy(matcher_.Distance(view.skyline, rotation)));
}

}  // namespace ridgeline
