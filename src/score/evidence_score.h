// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include "score/score.h"

namespace ridgeline {

// Weighted sum of the cues of PictureEvidence: the log-linear model P(pose) ~ exp(sum of w_k cue_k)
// over the poses of a search, whose weights are those of the highest likelihood of the true poses of
// the dev queries. The edges' cues are the score by edge types: each kind is weighted by how often it
// is seen in pictures, as a likelihood against lines at random; there is no other of that name.
class EvidenceScore final : public Score {
 public:
  // `evidence` and `model` must outlive the score. One weight per cue, >= 0. `tolerance_factor` as
  // in PictureEvidence::Lines.
  EvidenceScore(const PictureEvidence& evidence,
                const CityModel& model,
                const std::vector<double>& weights,
                double tolerance_factor);

  ViewParts parts() const override {
    return {true,
            weights_[kFacadeCue] > 0.0 || weights_[kRegionCue] > 0.0 ||
                weights_[kFacadeColourCue] > 0.0};
  }
  const char* unusable() const override {
    return evidence_.is_blank() ? "the picture has no lines and one colour" : "";
  }
  double LogRatio(const PositionView& view,
                  const Pose& cam_from_local,
                  PictureEvidence::Workspace& workspace) const override;

 private:
  const PictureEvidence& evidence_;
  const CityModel& model_;
  LineLikelihood lines_;
  std::array<double, kCues> weights_{};
};

}  // namespace ridgeline
