// SPDX-License-Identifier: Apache-2.0
#include "score/unexplained_score.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <string>

#include "score/edge_samples.h"
#include "score/score_plugin.h"

namespace ridgeline {
namespace {

constexpr int kGrid = 64;  // cells along the longer side
constexpr int kDirections = OrientedDistanceField::kDirections;
constexpr std::uint32_t kOutline = 1u << kDirections;  // of the cell mask, above the direction bits

std::uint32_t WithNeighbours(int direction) {
  return 1u << direction | 1u << (direction + 1) % kDirections |
         1u << (direction + kDirections - 1) % kDirections;
}

// Direction bits of the edges in and beside each cell.
class CellMasks {
 public:
  void Mark(int column, int row, int radius, std::uint32_t bits) {
    for (int y = std::max(0, row - radius); y <= std::min(kGrid - 1, row + radius); ++y) {
      for (int x = std::max(0, column - radius); x <= std::min(kGrid - 1, column + radius); ++x) {
        masks_[y * kGrid + x] |= bits;
      }
    }
  }
  std::uint32_t At(int cell) const { return masks_[cell]; }

 private:
  std::array<std::uint32_t, kGrid * kGrid> masks_{};
};

}  // namespace

UnexplainedScore::UnexplainedScore(std::span<const LineSegment> segments,
                                   const OrientedDistanceField& field,
                                   const PinholeCamera& camera,
                                   const UnexplainedScoreOptions& options)
    : field_(field),
      camera_(camera),
      cell_px_(static_cast<float>(std::max(camera.width, camera.height)) / kGrid),
      spacing_px_(static_cast<float>(options.spacing_width * camera.width)),
      outline_cells_(std::max(
          1, static_cast<int>(std::lround(options.outline_width * camera.width / cell_px_)))),
      max_units_(static_cast<float>(options.max_distance_width * camera.width *
                                    OrientedDistanceField::kUnitsPerPx)) {
  std::vector<std::size_t> order(segments.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto strength = [&](std::size_t i) { return segments[i].Length() * segments[i].strength; };
  std::stable_sort(order.begin(), order.end(), [&](std::size_t x, std::size_t y) {
    return strength(x) > strength(y);
  });
  order.resize(std::min<std::size_t>(order.size(), options.max_lines));
  for (const std::size_t i : order) {
    const Eigen::Vector2f d = segments[i].b - segments[i].a;
    const int count = std::max(1, static_cast<int>(d.norm() / cell_px_ + 0.5f));
    for (int k = 0; k < count; ++k) {
      const Eigen::Vector2f p = segments[i].a + d * ((static_cast<float>(k) + 0.5f) / count);
      const int column = std::clamp(static_cast<int>(p.x() / cell_px_), 0, kGrid - 1);
      const int row = std::clamp(static_cast<int>(p.y() / cell_px_), 0, kGrid - 1);
      samples_.push_back({static_cast<std::uint16_t>(row * kGrid + column),
                          WithNeighbours(OrientedDistanceField::DirectionOf(d.x(), d.y())),
                          strength(i) / static_cast<float>(count)});
    }
  }
}

UnexplainedScore::Shares UnexplainedScore::SharesOf(std::span<const ProjectedSegment> segments,
                                                    std::span<const EdgeKind> kinds) const {
  Shares shares;
  if (samples_.empty()) return shares;
  shares.edges = std::max(
      0.0,
      MeanAlongEdges(
          segments, spacing_px_, camera_.width, camera_.height, [&](int direction, int x, int y) {
            return field_.Distance(direction, x, y) <= max_units_ ? 1.0 : 0.0;
          }));
  CellMasks masks;
  for (const ProjectedSegment& segment : segments) {
    const Eigen::Vector2f d = segment.b - segment.a;
    const std::uint32_t bit = 1u << OrientedDistanceField::DirectionOf(d.x(), d.y());
    const EdgeKind kind = kinds[segment.piece];
    const bool is_outline = kind == EdgeKind::kSkyline || kind == EdgeKind::kOcclusion;
    const int steps = std::max(1, static_cast<int>(d.norm() / cell_px_ + 0.5f));
    for (int k = 0; k <= steps; ++k) {
      const Eigen::Vector2f p = segment.a + d * (static_cast<float>(k) / static_cast<float>(steps));
      const int column = static_cast<int>(p.x() / cell_px_);
      const int row = static_cast<int>(p.y() / cell_px_);
      masks.Mark(column, row, 1, bit);
      if (is_outline) masks.Mark(column, row, outline_cells_, kOutline);
    }
  }
  double explained = 0.0;
  double total = 0.0;
  for (const Sample& sample : samples_) {
    const std::uint32_t mask = masks.At(sample.cell);
    if ((mask & kOutline) == 0) continue;
    total += sample.weight;
    if ((mask & sample.directions) != 0) explained += sample.weight;
  }
  if (total > 0.0) shares.lines = explained / total;
  return shares;
}

double UnexplainedScore::LogRatio(const PositionView& view,
                                  const Pose& cam_from_local,
                                  Workspace& workspace) const {
  ProjectPieces(view.visible, camera_, cam_from_local, workspace.segments);
  return LogRatioOf(SharesOf(workspace.segments, view.kinds).Energy());
}

extern const ScorePlugin kUnexplainedScore;
constinit const ScorePlugin kUnexplainedScore = {
    .name = "unexplained",
    .declare = [](OptionGroups& options) { options.Add<UnexplainedScoreOptions>("unexplained"); },
    .make = [](const ScoreContext& c) -> std::unique_ptr<Score> {
      return std::make_unique<UnexplainedScore>(c.picture.segments(),
                                                c.picture.field(),
                                                c.picture.camera(),
                                                c.options.groups.Get<UnexplainedScoreOptions>());
    }};

}  // namespace ridgeline
