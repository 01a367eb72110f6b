// SPDX-License-Identifier: Apache-2.0
#include "score/line_energy_score.h"

#include "score/score_plugin.h"

namespace ridgeline {

LineEnergyScore::LineEnergyScore(std::span<const LineSegment> segments,
                                 const PinholeCamera& camera,
                                 const LineEnergyOptions& options)
    : camera_(camera), energy_(segments, camera.width, options) {}

std::unique_ptr<Score::Workspace> LineEnergyScore::NewWorkspace() const {
  return std::make_unique<Memory>();
}

double LineEnergyScore::LogRatio(const PositionView& view,
                                 const Pose& cam_from_local,
                                 Workspace& workspace) const {
  ProjectPieces(view.visible, camera_, cam_from_local, workspace.segments);
  std::vector<LineSegment>& lines = static_cast<Memory&>(workspace).lines;
  lines.clear();
  for (const ProjectedSegment& segment : workspace.segments) {
    lines.push_back({segment.a, segment.b, 1.0f});
  }
  return LogRatioOf(energy_.Energy(lines));
}

extern const ScorePlugin kLineEnergyScore;
constinit const ScorePlugin kLineEnergyScore = {
    .name = "line_energy",
    .declare = [](OptionGroups& options) { options.Add<LineEnergyOptions>("line_energy"); },
    .make = [](const ScoreContext& c) -> std::unique_ptr<Score> {
      return std::make_unique<LineEnergyScore>(
          c.picture.segments(), c.picture.camera(), c.options.groups.Get<LineEnergyOptions>());
    }};

}  // namespace ridgeline
