// SPDX-License-Identifier: Apache-2.0
#include "score/zbuffer_line_energy_score.h"

#include "score/score_plugin.h"

namespace ridgeline {

ZbufferLineEnergyScore::ZbufferLineEnergyScore(std::span<const LineSegment> segments,
                                               const PinholeCamera& camera,
                                               const CityModel& model,
                                               const LineEnergyOptions& options,
                                               const ZbufferHoughOptions& zbuffer)
    : camera_(camera), model_(model), energy_(segments, camera.width, options), zbuffer_(zbuffer) {}

std::unique_ptr<Score::Workspace> ZbufferLineEnergyScore::NewWorkspace() const {
  return std::make_unique<Memory>();
}

double ZbufferLineEnergyScore::LogRatio(const PositionView& /*view*/,
                                        const Pose& cam_from_local,
                                        Workspace& workspace) const {
  std::vector<LineSegment>& lines = static_cast<Memory&>(workspace).lines;
  lines.clear();
  for (const ProjectedSegment& segment :
       ZbufferHoughSegments(model_, camera_, cam_from_local, zbuffer_)) {
    lines.push_back({segment.a, segment.b, 1.0f});
  }
  return LogRatioOf(energy_.Energy(lines));
}

extern const ScorePlugin kZbufferLineEnergyScore;
constinit const ScorePlugin kZbufferLineEnergyScore = {
    .name = "line_energy_zbuffer",
    .declare =
        [](OptionGroups& options) {
          options.Add<LineEnergyOptions>("line_energy");
          options.Add<ZbufferHoughOptions>("zbuffer_hough");
        },
    .make = [](const ScoreContext& c) -> std::unique_ptr<Score> {
      return std::make_unique<ZbufferLineEnergyScore>(c.picture.segments(),
                                                      c.picture.camera(),
                                                      c.scene.model(),
                                                      c.options.groups.Get<LineEnergyOptions>(),
                                                      c.options.groups.Get<ZbufferHoughOptions>());
    }};

}  // namespace ridgeline
