// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "score/score.h"
#include "score/skyline_l1.h"

namespace ridgeline {

// The distance of Ayadi et al. between real and virtual skyline, as a score of poses.
class SkylineL1Score final : public Score {
 public:
  explicit SkylineL1Score(const SkylineL1& matcher) : matcher_(matcher) {}

  ViewParts parts() const override { return {true, false}; }
  const char* unusable() const override {
    return matcher_.use() == SkylineUse::kUsable ? "" : ReasonOf(matcher_.use());
  }
  double LogRatio(const PositionView& view,
                  const Pose& cam_from_local,
                  Workspace& workspace) const override;

 private:
  SkylineL1 matcher_;
};

}  // namespace ridgeline
