// SPDX-License-Identifier: Apache-2.0
#include "score/oriented_chamfer_score.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "score/edge_samples.h"
#include "score/score_plugin.h"

namespace ridgeline {
namespace {

constexpr int kTurns = OrientedDistanceField::kDirections;
constexpr int kFar = 255;

}  // namespace

OrientedChamferScore::OrientedChamferScore(const OrientedDistanceField& field,
                                           const PinholeCamera& camera,
                                           const OrientedChamferOptions& options)
    : camera_(camera),
      spacing_px_(static_cast<float>(options.spacing_width * camera.width)),
      limit_units_(static_cast<float>(std::min<double>(
          kFar, options.max_distance_width * camera.width * OrientedDistanceField::kUnitsPerPx))) {
  const std::size_t pixels = static_cast<std::size_t>(field.width()) * field.height();
  costs_.resize(kTurns * pixels);
  for (int direction = 0; direction < kTurns; ++direction) {
    std::uint8_t* costs = &costs_[direction * pixels];
    for (int y = 0; y < field.height(); ++y) {
      for (int x = 0; x < field.width(); ++x) *costs++ = field.Distance(direction, x, y);
    }
  }
  has_lines_ = std::any_of(costs_.begin(), costs_.end(), [](std::uint8_t c) { return c == 0; });
  // A step to the next direction costs its angle; two turns each way reach all of them.
  constexpr double kStepDeg = 180.0 / kTurns;
  const int step =
      std::max(1,
               static_cast<int>(std::lround(kStepDeg * options.per_degree_width * camera.width *
                                            OrientedDistanceField::kUnitsPerPx)));
  const auto relax = [&](int to, int from) {
    std::uint8_t* target = &costs_[to * pixels];
    const std::uint8_t* source = &costs_[from * pixels];
    for (std::size_t i = 0; i < pixels; ++i) {
      target[i] = static_cast<std::uint8_t>(std::min<int>(target[i], source[i] + step));
    }
  };
  for (int k = 1; k < 2 * kTurns; ++k) relax(k % kTurns, (k - 1) % kTurns);
  for (int k = 2 * kTurns - 1; k > 0; --k) relax((k - 1) % kTurns, k % kTurns);
}

double OrientedChamferScore::EnergyOfEdges(std::span<const ProjectedSegment> segments) const {
  if (!has_lines_) return 1.0;
  const std::size_t pixels = static_cast<std::size_t>(camera_.width) * camera_.height;
  const double mean = MeanAlongEdges(
      segments, spacing_px_, camera_.width, camera_.height, [&](int direction, int x, int y) {
        const float cost =
            costs_[direction * pixels + static_cast<std::size_t>(y) * camera_.width + x];
        return static_cast<double>(std::min(cost, limit_units_));
      });
  return mean < 0.0 ? 1.0 : mean / limit_units_;
}

double OrientedChamferScore::LogRatio(const PositionView& view,
                                      const Pose& cam_from_local,
                                      Workspace& workspace) const {
  ProjectPieces(view.visible, camera_, cam_from_local, workspace.segments);
  return LogRatioOf(EnergyOfEdges(workspace.segments));
}

extern const ScorePlugin kOrientedChamferScore;
constinit const ScorePlugin kOrientedChamferScore = {
    .name = "oriented_chamfer",
    .declare =
        [](OptionGroups& options) { options.Add<OrientedChamferOptions>("oriented_chamfer"); },
    .make = [](const ScoreContext& c) -> std::unique_ptr<Score> {
      return std::make_unique<OrientedChamferScore>(
          c.picture.field(), c.picture.camera(), c.options.groups.Get<OrientedChamferOptions>());
    }};

}  // namespace ridgeline
