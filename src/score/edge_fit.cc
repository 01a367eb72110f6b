// SPDX-License-Identifier: Apache-2.0
#include "score/edge_fit.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

namespace ridgeline {
namespace {

// Heights that a roof is tried at [m].
constexpr int kShifts = 17;
constexpr double kMaxShiftM = 2.0;
constexpr double kShiftStepM = 2.0 * kMaxShiftM / (kShifts - 1);
// Prior of the shift: most roofs are right to a quarter of a metre, some are off by far.
constexpr double kSureSigmaM = 0.25;
constexpr double kOffShare = 0.2;

double ShiftOf(int i) { return -kMaxShiftM + kShiftStepM * i; }

double LogPriorOfShift(double shift_m) {
  const double near =
      std::exp(-0.5 * shift_m * shift_m / (kSureSigmaM * kSureSigmaM)) / (kSureSigmaM * 2.5066);
  return std::log((1.0 - kOffShare) * near + kOffShare / (2.0 * kMaxShiftM));
}

// Whether an edge goes up and down with a roof, and whose roof that is.
std::uint32_t RoofOf(const FeatureEdge& edge, const CityModel& model) {
  for (const std::uint32_t surface : {edge.surface0, edge.surface1}) {
    if (surface != kNoSurface && model.surfaces[surface].surface_class == SurfaceClass::kRoof) {
      return surface;
    }
  }
  return kNoSurface;
}

struct Sums {
  BuildingFit fit;
  std::array<double, kShifts> by_shift{};
};

}  // namespace

EdgeFit::EdgeFit(const OrientedDistanceField& field,
                 const PinholeCamera& camera,
                 const LineLikelihoodOptions& options)
    : field_(field),
      camera_(camera),
      spacing_px_(options.spacing_width * field.width()),
      sigma_px_(options.sigma_width * field.width()),
      sigma_model_px_m_(options.sigma_model_m * camera.fx) {
  constexpr std::size_t kCells =
      static_cast<std::size_t>(kEdgeKinds) * LineLikelihood::kSigmaLevels * kDensityLevels;
  ratios_.assign(kCells * kDistances, 0.0f);
  cells_.assign(kCells, {});
  for (int kind = 0; kind < kEdgeKinds; ++kind) {
    for (int sigma = 0; sigma < LineLikelihood::kSigmaLevels; ++sigma) {
      for (int level = 0; level < OrientedDistanceField::kDensityLevels; ++level) {
        const double rate = 2.0 * OrientedDistanceField::DensityOfLevel(level);
        const std::size_t cell = CellIndex(static_cast<EdgeKind>(kind), sigma, level);
        double expected = 0.0;
        double chance = 0.0;
        for (int units = 0; units < kDistances; ++units) {
          const double distance_px = units / OrientedDistanceField::kUnitsPerPx;
          const double ratio = LineLogRatio(distance_px,
                                            units + 1 == kDistances,
                                            LineLikelihood::SigmaOfLevel(sigma),
                                            0.5 * rate,
                                            options.seen_share[kind]);
          ratios_[cell * kDistances + units] = static_cast<float>(ratio);
          const double from = std::exp(-rate * units / OrientedDistanceField::kUnitsPerPx);
          const double to =
              units + 1 == kDistances
                  ? 0.0
                  : std::exp(-rate * (units + 1) / OrientedDistanceField::kUnitsPerPx);
          chance += (from - to) * ratio;
          expected += (from - to) * std::exp(ratio) * ratio;
        }
        cells_[cell] = {static_cast<float>(expected), static_cast<float>(chance)};
      }
    }
  }
}

int EdgeFit::SigmaLevel(float inverse_depth) const {
  return LineLikelihood::LevelOfSigma(std::hypot(sigma_px_, sigma_model_px_m_ * inverse_depth));
}

std::vector<BuildingFit> EdgeFit::Of(std::span<const ProjectedSegment> segments,
                                     const VisibleSet& visible,
                                     std::span<const EdgeKind> kinds,
                                     std::span<const double> weights,
                                     const Scene& scene,
                                     const Pose& cam_from_local) const {
  const CityModel& model = scene.model();
  const Eigen::Vector3f up =
      (cam_from_local.cam_from_world * Eigen::Vector3d::UnitZ()).cast<float>();
  const Eigen::Vector2f up_px(static_cast<float>(camera_.fx) * up.x(),
                              static_cast<float>(camera_.fy) * up.y());
  const Eigen::Vector2f center_px(static_cast<float>(camera_.cx), static_cast<float>(camera_.cy));
  const Eigen::Vector2f last(static_cast<float>(field_.width()) - 1.0f,
                             static_cast<float>(field_.height()) - 1.0f);
  std::map<std::uint32_t, Sums> by_building;
  for (const ProjectedSegment& segment : segments) {
    const VisiblePiece& piece = visible.pieces[segment.piece];
    const FeatureEdge& edge = scene.edge(piece.edge);
    const EdgeKind kind = kinds[segment.piece];
    const double weight = weights[static_cast<std::size_t>(kind)];
    const std::uint32_t roof = RoofOf(edge, model);
    const std::uint32_t surface = roof != kNoSurface           ? roof
                                  : edge.surface0 != kNoSurface ? edge.surface0
                                                                : edge.surface1;
    if (surface == kNoSurface) continue;
    const Eigen::Vector3f along = (piece.b - piece.a).normalized();
    const bool goes_with_roof = roof != kNoSurface && std::abs(along.z()) < 0.9f;
    Sums& sums = by_building[model.surfaces[surface].building];
    const Eigen::Vector2f d = segment.b - segment.a;
    const double length = d.norm();
    const int samples = std::max(1, static_cast<int>(length / spacing_px_ + 0.5));
    const double share = weight * std::min(1.0, length / (spacing_px_ * samples));
    const int direction = OrientedDistanceField::DirectionOf(d.x(), d.y());
    const int level_a = SigmaLevel(segment.inverse_depth_a);
    const int level_b = SigmaLevel(segment.inverse_depth_b);
    sums.fit.length_px += length;
    for (int i = 0; i < samples; ++i) {
      const float t = (static_cast<float>(i) + 0.5f) / static_cast<float>(samples);
      const Eigen::Vector2f p = segment.a + t * d;
      const float inverse_depth =
          segment.inverse_depth_a + t * (segment.inverse_depth_b - segment.inverse_depth_a);
      // The image of the point moves by this for a metre of height [px / m].
      const Eigen::Vector2f rise = inverse_depth * (up_px - up.z() * (p - center_px));
      const int sigma = static_cast<int>(static_cast<float>(level_a) +
                                         t * static_cast<float>(level_b - level_a) + 0.5f);
      const auto ratio_at = [&](const Eigen::Vector2f& q, std::size_t& cell) {
        const Eigen::Vector2f inside = q.cwiseMax(0.0f).cwiseMin(last);
        const int x = static_cast<int>(inside.x());
        const int y = static_cast<int>(inside.y());
        cell = CellIndex(kind, sigma, field_.DensityLevel(direction, x, y));
        return ratios_[cell * kDistances + field_.Distance(direction, x, y)];
      };
      std::size_t cell = 0;
      const double ratio = share * ratio_at(p, cell);
      sums.fit.observed += ratio;
      sums.fit.expected += share * cells_[cell].expected;
      sums.fit.chance += share * cells_[cell].chance;
      if (!goes_with_roof) continue;
      for (int s = 0; s < kShifts; ++s) {
        std::size_t moved = 0;
        const Eigen::Vector2f q = p + static_cast<float>(ShiftOf(s)) * rise;
        const bool leaves = (q.array() < 0.0f).any() || (q.array() > last.array()).any();
        if (!leaves) sums.by_shift[s] += share * ratio_at(q, moved) - ratio;
      }
    }
  }
  std::vector<BuildingFit> fits;
  for (auto& [building, sums] : by_building) {
    sums.fit.building = building;
    double best = LogPriorOfShift(0.0);
    for (int s = 0; s < kShifts; ++s) {
      const double log_posterior = sums.by_shift[s] + LogPriorOfShift(ShiftOf(s));
      if (log_posterior <= best) continue;
      best = log_posterior;
      sums.fit.roof_shift_m = ShiftOf(s);
      sums.fit.roof_gain = sums.by_shift[s];
    }
    fits.push_back(sums.fit);
  }
  return fits;
}

}  // namespace ridgeline
