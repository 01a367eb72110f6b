// SPDX-License-Identifier: Apache-2.0
#include "score/line_likelihood.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

namespace ridgeline {
namespace {

using simd::Float4;

constexpr std::size_t kLanes = 4;
constexpr float kSigmaRatio = 1.35f;  // between levels
constexpr float kSmallestSigmaPx = 0.75f;

// Of a line that is an edge's own: its density at a distance [1 / px], and the probability that it
// is farther away.
struct OwnLine {
  double density = 0.0;
  double beyond = 0.0;
};

OwnLine OwnLineAt(double distance_px, double sigma_px) {
  const double z = distance_px / sigma_px;
  return {std::sqrt(2.0 / M_PI) / sigma_px * std::exp(-0.5 * z * z), std::erfc(z / std::sqrt(2.0))};
}

}  // namespace

void LineLikelihoodOptions::Visit(OptionVisitor& v) {
  v.Field("seen_share", seen_share, Open(0.0, 1.0));
  v.Rule("seen_share",
         seen_share.size() == kEdgeKinds,
         std::to_string(seen_share.size()),
         "one number per kind of edge (5)");
  v.Field("sigma_width", sigma_width, Positive());
  v.Field("sigma_model_m", sigma_model_m, NotNegative());
  v.Field("spacing_width", spacing_width, Positive());
}

double LineLogRatio(double distance_px,
                    bool is_beyond,
                    double sigma_px,
                    double density,
                    double seen_share) {
  const OwnLine own = OwnLineAt(distance_px, sigma_px);
  const double ratio = (is_beyond ? 0.0 : own.density / (2.0 * density)) + own.beyond;
  return std::log(1.0 - seen_share + seen_share * ratio);
}

double LineLikelihood::SigmaOfLevel(int level) {
  return kSmallestSigmaPx * std::pow(kSigmaRatio, level);
}

int LineLikelihood::LevelOfSigma(double sigma_px) {
  const double level = std::log(sigma_px / kSmallestSigmaPx) / std::log(kSigmaRatio);
  return std::clamp(static_cast<int>(level + 0.5), 0, kSigmaLevels - 1);
}

LineLikelihood::LineLikelihood(const OrientedDistanceField& field,
                               const PinholeCamera& camera,
                               const LineLikelihoodOptions& options)
    : field_(field),
      spacing_px_(static_cast<float>(options.spacing_width * field.width())),
      table_(static_cast<std::size_t>(kEdgeKinds) * kSigmaLevels * kDensityLevels * kDistances) {
  const double detection_px = options.sigma_width * field.width();
  const double model_px_m = options.sigma_model_m * camera.fx;
  nearer_.fill(std::numeric_limits<float>::infinity());
  for (int level = 1; level < kSigmaLevels; ++level) {
    // Levels are rounded: from half a level below on.
    const double sigma_px = kSmallestSigmaPx * std::pow(kSigmaRatio, level - 0.5);
    const double of_model = sigma_px * sigma_px - detection_px * detection_px;
    if (of_model <= 0.0) {
      first_level_ = level;
    } else if (model_px_m > 0.0) {
      nearer_[level] = static_cast<float>(std::sqrt(of_model) / model_px_m);
    }
  }
  for (int sigma = first_level_; sigma < kSigmaLevels; ++sigma) {
    const double sigma_px = kSmallestSigmaPx * std::pow(kSigmaRatio, sigma);
    std::array<OwnLine, kDistances> own;
    for (int d = 0; d < kDistances; ++d) {
      own[d] = OwnLineAt(d * kUnitsPerDistance / OrientedDistanceField::kUnitsPerPx, sigma_px);
    }
    own.back().density = 0.0;  // the last distance stands for all larger ones
    for (int kind = 0; kind < kEdgeKinds; ++kind) {
      const double seen = options.seen_share[kind];
      for (int level = 0; level < OrientedDistanceField::kDensityLevels; ++level) {
        const double density = OrientedDistanceField::DensityOfLevel(level);
        float* const ratios = &table_[TableOf(static_cast<EdgeKind>(kind), sigma, level)];
        for (int d = 0; d < kDistances; ++d) {
          const double ratio = own[d].density / (2.0 * density) + own[d].beyond;
          ratios[d] = static_cast<float>(std::log(1.0 - seen + seen * ratio));
        }
      }
    }
  }
}

struct LineLikelihood::Strokes {
  simd::Float4 ax, ay, dx, dy;  // [px]
  simd::Float4 step;            // of the parameter, between samples
  simd::Float4 weight;          // of a sample
  simd::Float4 level_a, level_b;
  simd::Int4 samples, direction;
};

simd::Int4 LineLikelihood::SigmaLevels(Float4 inverse_depths) const {
  simd::Int4 levels = simd::Int4{} + first_level_;
  for (int level = first_level_ + 1; level < kSigmaLevels; ++level) {
    levels -= inverse_depths >= nearer_[level];  // true is -1
  }
  return levels;
}

LineLikelihood::Strokes LineLikelihood::StrokesOf(const ProjectedSegment* segments,
                                                  std::size_t count) const {
  Strokes s;
  Float4 inverse_depth_a;
  Float4 inverse_depth_b;
  for (std::size_t k = 0; k < kLanes; ++k) {
    const ProjectedSegment& segment = segments[std::min(k, count - 1)];
    s.ax[k] = segment.a.x();
    s.ay[k] = segment.a.y();
    s.dx[k] = segment.b.x();
    s.dy[k] = segment.b.y();
    inverse_depth_a[k] = segment.inverse_depth_a;
    inverse_depth_b[k] = segment.inverse_depth_b;
  }
  s.dx -= s.ax;
  s.dy -= s.ay;
  const Float4 length = simd::Sqrt(s.dx * s.dx + s.dy * s.dy);
  s.samples = __builtin_convertvector(length / spacing_px_ + 0.5f, simd::Int4);
  s.samples = s.samples > 1 ? s.samples : simd::Int4{1, 1, 1, 1};
  const Float4 samples = __builtin_convertvector(s.samples, Float4);
  s.step = 1.0f / samples;
  // A segment shorter than the spacing counts by its length.
  s.weight = simd::Min(simd::Splat(1.0f), length / (spacing_px_ * samples));
  s.direction = OrientedDistanceField::DirectionsOf(s.dx, s.dy);
  s.level_a = __builtin_convertvector(SigmaLevels(inverse_depth_a), Float4);
  s.level_b = __builtin_convertvector(SigmaLevels(inverse_depth_b), Float4);
  return s;
}

float LineLikelihood::SumAlong(const Strokes& s, int lane, EdgeKind kind) const {
  constexpr Float4 kMiddles = {0.5f, 1.5f, 2.5f, 3.5f};
  const Float4 max_x = simd::Splat(static_cast<float>(field_.width()) - 1.0f);
  const Float4 max_y = simd::Splat(static_cast<float>(field_.height()) - 1.0f);
  const Float4 zero = simd::Splat(0.0f);
  const Float4 step = simd::Splat(s.step[lane]);
  const int samples = s.samples[lane];
  const OrientedDistanceField::Plane plane = field_.PlaneOf(s.direction[lane]);
  float sum = 0.0f;
  for (int i = 0; i < samples; i += static_cast<int>(kLanes)) {
    const Float4 t = (static_cast<float>(i) + kMiddles) * step;
    const Float4 place_x = simd::Min(simd::Max(s.ax[lane] + t * s.dx[lane], zero), max_x);
    const Float4 place_y = simd::Min(simd::Max(s.ay[lane] + t * s.dy[lane], zero), max_y);
    const Float4 level = s.level_a[lane] + t * (s.level_b[lane] - s.level_a[lane]) + 0.5f;
    const simd::Int4 columns = __builtin_convertvector(place_x, simd::Int4);
    const simd::Int4 rows = __builtin_convertvector(place_y, simd::Int4);
    const simd::Int4 levels = __builtin_convertvector(level, simd::Int4);
    const int count = std::min(samples - i, static_cast<int>(kLanes));
    for (int k = 0; k < count; ++k) {
      const auto x = static_cast<unsigned>(columns[k]);
      const auto y = static_cast<unsigned>(rows[k]);
      sum += table_[TableOf(kind, levels[k], plane.DensityLevel(x, y)) +
                    plane.Distance(x, y) / kUnitsPerDistance];
    }
  }
  return sum;
}

std::array<float, kEdgeKinds> LineLikelihood::LogRatios(std::span<const ProjectedSegment> segments,
                                                        std::span<const EdgeKind> kinds) const {
  std::array<float, kEdgeKinds> sums{};
  for (std::size_t i = 0; i < segments.size(); i += kLanes) {
    const std::size_t count = std::min(kLanes, segments.size() - i);
    const Strokes strokes = StrokesOf(&segments[i], count);
    for (std::size_t k = 0; k < count; ++k) {
      const EdgeKind kind = kinds[segments[i + k].piece];
      const int lane = static_cast<int>(k);
      sums[static_cast<std::size_t>(kind)] += SumAlong(strokes, lane, kind) * strokes.weight[lane];
    }
  }
  return sums;
}

}  // namespace ridgeline
