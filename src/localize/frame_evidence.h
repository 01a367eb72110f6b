// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "localize/goodness.h"
#include "localize/localizer.h"

namespace ridgeline {

// What one picture says of poses, without a decision: for whoever weighs the evidence of many
// pictures against each other (src/track). The picture is looked at once, in the constructor.
class FrameEvidence {
 public:
  struct Mode {
    Pose cam_from_local;
    double log_ratio = 0.0;  // of the picture, without the prior
  };

  // What a box of poses has to offer.
  struct Modes {
    std::vector<Mode> modes;  // distinct, refined, best first; empty: none sees the model
    EnergyMap map;            // world frame
    std::uint64_t evaluations = 0;
  };

  // @param input  Picture, camera and lines; its prior is not looked at.
  // The localizer must outlive the evidence. Throws InputError for a picture whose size is not the
  // camera's.
  FrameEvidence(const Localizer& localizer, const LocalizationInput& input, int threads);
  ~FrameEvidence();
  FrameEvidence(FrameEvidence&&) noexcept;

  // Why the picture says nothing of any pose, in words; empty: it does.
  const std::string& unusable() const;

  // The modes of the box around a prior, found and refined as Localizer::Localize() does.
  // Throws InputError for a prior that has neither a height nor a terrain below it.
  Modes Search(const PosePrior& prior,
               const PoseSpaceOptions& ranges,
               std::uint64_t seed,
               int threads) const;

  // Log likelihood ratios of the picture at poses of any places; -infinity: in a building, below
  // the terrain, or without the model in view. Visibility is shared by poses within `cell_m` of each
  // other: they should be as near as half of the error that is tolerated.
  std::vector<double> LogRatios(std::span<const Pose> cam_from_local,
                                double cell_m,
                                int threads) const;

  // What speaks for a pose in absolute terms.
  Goodness GoodnessAt(const Pose& cam_from_local) const;

  // Whether a camera can be at a place (local).
  bool IsAdmissible(const Eigen::Vector3d& position) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace ridgeline
