// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "camera/intrinsics.h"
#include "score/line_energy.h"
#include "score/score.h"

namespace ridgeline {

// The energy of Loeper et al. on exact visible edges.
class LineEnergyScore final : public Score {
 public:
  // @param segments  Of the picture, in the pixels of `camera`.
  LineEnergyScore(std::span<const LineSegment> segments,
                  const PinholeCamera& camera,
                  const LineEnergyOptions& options);

  ViewParts parts() const override { return {true, false}; }
  const char* unusable() const override {
    return energy_.has_lines() ? "" : "the picture has no lines";
  }
  std::unique_ptr<Workspace> NewWorkspace() const override;
  double LogRatio(const PositionView& view,
                  const Pose& cam_from_local,
                  Workspace& workspace) const override;

 private:
  struct Memory final : Workspace {
    std::vector<LineSegment> lines;  // of the model
  };

  PinholeCamera camera_;
  LineEnergy energy_;
};

}  // namespace ridgeline
