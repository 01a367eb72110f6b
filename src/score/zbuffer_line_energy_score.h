// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "camera/intrinsics.h"
#include "projection/zbuffer_hough.h"
#include "score/line_energy.h"
#include "score/score.h"

namespace ridgeline {

// The energy of Loeper et al. with the model's lines as the paper finds them: z-buffer, Canny,
// Hough. Looks at the whole scene for every pose.
class ZbufferLineEnergyScore final : public Score {
 public:
  // @param segments  Of the picture, in the pixels of `camera`. `model` must outlive the score.
  ZbufferLineEnergyScore(std::span<const LineSegment> segments,
                         const PinholeCamera& camera,
                         const CityModel& model,
                         const LineEnergyOptions& options,
                         const ZbufferHoughOptions& zbuffer);

  ViewParts parts() const override { return {false, false}; }
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
  const CityModel& model_;
  LineEnergy energy_;
  ZbufferHoughOptions zbuffer_;
};

}  // namespace ridgeline
