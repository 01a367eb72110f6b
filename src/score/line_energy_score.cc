// SPDX-License-Identifier: Apache-2.0
#include "score/line_energy_score.h"

namespace ridgeline {

LineEnergyScore::LineEnergyScore(std::span<const LineSegment> segments,
                                 const PinholeCamera& camera,
                                 const LineEnergyOptions& options)
    : camera_(camera), energy_(segments, camera.width, options) {}

double LineEnergyScore::LogRatio(const PositionView& view,
                                 const Pose& cam_from_local,
                                 PictureEvidence::Workspace& workspace) const {
  ProjectPieces(view.visible, camera_, cam_from_local, workspace.segments);
  workspace.lines.clear();
  for (const ProjectedSegment& segment : workspace.segments) {
    workspace.lines.push_back({segment.a, segment.b, 1.0f});
  }
  return LogRatioOf(energy_.Energy(workspace.lines));
}

}  // namespace ridgeline
