// SPDX-License-Identifier: Apache-2.0
#include "score/ray_line_energy_score.h"

#include "score/score_plugin.h"

namespace ridgeline {

RayLineEnergyScore::RayLineEnergyScore(std::span<const LineSegment> segments,
                                       const PinholeCamera& camera,
                                       const CityModel& model,
                                       const ProjectionOptions& projection,
                                       const LineEnergyOptions& energy,
                                       const RayEdgeOptions& rays)
    : camera_(camera),
      visibility_(model, nullptr, projection),
      energy_(segments, camera.width, energy),
      rays_(rays) {}

std::unique_ptr<Score::Workspace> RayLineEnergyScore::NewWorkspace() const {
  return std::make_unique<Memory>();
}

double RayLineEnergyScore::LogRatio(const PositionView& /*view*/,
                                    const Pose& cam_from_local,
                                    Workspace& workspace) const {
  Memory& memory = static_cast<Memory&>(workspace);
  const Eigen::Vector3d& position = cam_from_local.center_in_world;
  if (!memory.looked || memory.visible.position != position) {
    memory.visible.position = position;
    memory.visible.pieces = visibility_.PiecesFrom(position, rays_.max_distance_m, rays_.step_mrad);
    memory.looked = true;
  }
  ProjectPieces(memory.visible, camera_, cam_from_local, memory.segments);
  memory.lines.clear();
  for (const ProjectedSegment& segment : memory.segments) {
    memory.lines.push_back({segment.a, segment.b, 1.0f});
  }
  return LogRatioOf(energy_.Energy(memory.lines));
}

extern const ScorePlugin kRayLineEnergyScore;
constinit const ScorePlugin kRayLineEnergyScore = {
    .name = "line_energy_rays",
    .declare =
        [](OptionGroups& options) {
          options.Add<LineEnergyOptions>("line_energy");
          options.Add<RayEdgeOptions>("rays");
        },
    .make = [](const ScoreContext& c) -> std::unique_ptr<Score> {
      return std::make_unique<RayLineEnergyScore>(c.picture.segments(),
                                                  c.picture.camera(),
                                                  c.scene.model(),
                                                  c.scene.options(),
                                                  c.options.groups.Get<LineEnergyOptions>(),
                                                  c.options.groups.Get<RayEdgeOptions>());
    }};

}  // namespace ridgeline
