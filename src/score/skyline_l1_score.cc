// SPDX-License-Identifier: Apache-2.0
#include "score/skyline_l1_score.h"

#include "score/score_plugin.h"
#include "skyline/skyline_extractor.h"

namespace ridgeline {

double SkylineL1Score::LogRatio(const PositionView& view,
                                const Pose& cam_from_local,
                                Workspace& /*workspace*/) const {
  const Eigen::Matrix3f rotation = cam_from_local.cam_from_world.toRotationMatrix().cast<float>();
  return LogRatioOf(matcher_.Energy(matcher_.Distance(view.skyline, rotation)));
}

extern const ScorePlugin kSkylineL1Score;
constinit const ScorePlugin kSkylineL1Score = {
    .name = "skyline_l1",
    .declare =
        [](OptionGroups& options) {
          options.Add<SkylineOptions>("skyline");
          options.Add<SkylineL1Options>("skyline_l1");
        },
    .make = [](const ScoreContext& c) -> std::unique_ptr<Score> {
      const OptionGroups& options = c.options.groups;
      const Skyline skyline = ExtractSkyline(c.picture.full_bgr(), options.Get<SkylineOptions>());
      return std::make_unique<SkylineL1Score>(
          SkylineL1(skyline, c.picture.full_camera(), options.Get<SkylineL1Options>()));
    }};

}  // namespace ridgeline
