// SPDX-License-Identifier: Apache-2.0
#include "score/zbuffer_line_energy_score.h"

namespace ridgeline {

ZbufferLineEnergyScore::ZbufferLineEnergyScore(std::span<const LineSegment> segments,
                                               const PinholeCamera& camera,
                                               const CityModel& model,
                                               const LineEnergyOptions& options,
                                               const ZbufferHoughOptions& zbuffer)
    : camera_(camera),
      model_(model),
      energy_(segments, camera.width, options),
      zbuffer_(zbuffer) {}

double ZbufferLineEnergyScore::LogRatio(const PositionView& /*view*/,
                                        const Pose& cam_from_local,
                                        PictureEvidence::Workspace& workspace) const {
  workspace.lines.clear();
  for (const ProjectedSegment& segment :
       ZbufferHoughSegments(model_, camera_, cam_from_local, zbuffer_)) {
    workspace.lines.push_back({segment.a, segment.b, 1.0f});
  }
  return LogRatioOf(energy_.Energy(workspace.lines));
}

}  // namespace ridgeline
