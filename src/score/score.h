// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "score/picture_evidence.h"
#include "score/position_view.h"

namespace ridgeline {

// Compares a picture with what the model shows from a pose. Thread-safe; never sees the truth.
class Score {
 public:
  virtual ~Score() = default;

  // What LogRatio() reads of a view.
  virtual ViewParts parts() const = 0;

  // Why this picture gives every pose the energy 1, in words ("the picture has no lines"); empty if it
  // does not.
  virtual const char* unusable() const { return ""; }

  // Log likelihood ratio of the pose against chance, or what comes nearest to it; higher is better.
  // Without anything of the model in view it is -infinity.
  virtual double LogRatio(const PositionView& view,
                          const Pose& cam_from_local,
                          PictureEvidence::Workspace& workspace) const = 0;

  // [0, 1], 0 best: 1 / (1 + exp(log_ratio / 10)); 1 where nothing is in view.
  static double EnergyOf(double log_ratio);
  // The inverse, for scores that are energies by themselves.
  static double LogRatioOf(double energy);
};

}  // namespace ridgeline
