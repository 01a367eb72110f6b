// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "base/options.h"
#include "camera/intrinsics.h"
#include "projection/ray_visibility.h"
#include "score/line_energy.h"
#include "score/score.h"

namespace ridgeline {

struct RayEdgeOptions {
  // Spacing of the rays along an edge, as seen from the position [mrad].
  double step_mrad = 4.0;
  // Edges farther than this are ignored [m].
  double max_distance_m = 200.0;

  void Visit(OptionVisitor& v) {
    v.Field("step_mrad", step_mrad, Closed(0.1, 1000.0));
    v.Field("max_distance_m", max_distance_m, Positive());
  }
};

// The energy of Loeper et al. on edges whose visibility is sampled by rays: a cross-check of
// "line_energy". The terrain hides nothing, as in the paper. Casts the rays anew for every pose.
class RayLineEnergyScore final : public Score {
 public:
  // @param segments  Of the picture, in the pixels of `camera`. `model` must outlive the score.
  RayLineEnergyScore(std::span<const LineSegment> segments,
                     const PinholeCamera& camera,
                     const CityModel& model,
                     const ProjectionOptions& projection,
                     const LineEnergyOptions& energy,
                     const RayEdgeOptions& rays);

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
    VisibleSet visible;
    bool looked = false;
    std::vector<LineSegment> lines;  // of the model
  };

  PinholeCamera camera_;
  RayVisibility visibility_;
  LineEnergy energy_;
  RayEdgeOptions rays_;
};

}  // namespace ridgeline
