// SPDX-License-Identifier: Apache-2.0
#include "score/line_likelihood.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "base/error.h"

namespace ridgeline {
namespace {

constexpr float kSigmaRatio = 1.35f;  // between levels
constexpr float kSmallestSigmaPx = 0.75f;

}  // namespace

double LineLogRatio(int units, double sigma_px, double density, double seen_share) {
  const double d = units / OrientedDistanceField::kUnitsPerPx;
  const double hit = std::sqrt(2.0 / M_PI) / sigma_px * std::exp(-0.5 * d * d / (sigma_px * sigma_px));
  const double hit_beyond = std::erfc(d / sigma_px / std::sqrt(2.0));
  // The last distance stands for all larger ones.
  const double ratio = (units == 255 ? 0.0 : hit / (2.0 * density)) + hit_beyond;
  return std::log(1.0 - seen_share + seen_share * ratio);
}

double LineLikelihood::SigmaOfLevel(int level) {
  return kSmallestSigmaPx * std::pow(kSigmaRatio, level);
}

int LineLikelihood::LevelOfSigma(double sigma_px) {
  const double level = std::log(sigma_px / kSmallestSigmaPx) / std::log(kSigmaRatio);
  return std::clamp(static_cast<int>(level + 0.5), 0, kSigmaLevels - 1);
}

void LineLikelihoodOptions::Validate() const {
  const auto fail = [](const std::string& name, double value, const std::string& expected) {
    throw InputError("", "score.lines." + name, std::to_string(value), expected);
  };
  if (seen_share.size() != kEdgeKinds) {
    fail("seen_share", static_cast<double>(seen_share.size()), "one number per kind of edge (5)");
  }
  for (const double share : seen_share) {
    if (!(share > 0.0 && share < 1.0)) fail("seen_share", share, "(0, 1)");
  }
  if (!(sigma_width > 0.0)) fail("sigma_width", sigma_width, "> 0");
  if (!(sigma_model_m >= 0.0)) fail("sigma_model_m", sigma_model_m, ">= 0");
  if (!(spacing_width > 0.0)) fail("spacing_width", spacing_width, "> 0");
}

LineLikelihood::LineLikelihood(const OrientedDistanceField& field,
                               const PinholeCamera& camera,
                               const LineLikelihoodOptions& options)
    : field_(field),
      spacing_px_(static_cast<float>(options.spacing_width * field.width())),
      sigma_px_(static_cast<float>(options.sigma_width * field.width())),
      sigma_model_px_m_(static_cast<float>(options.sigma_model_m * camera.fx)),
      table_(static_cast<std::size_t>(kEdgeKinds) * kSigmaLevels * kDensityLevels * kDistances) {
  float* ratio = table_.data();
  for (int kind = 0; kind < kEdgeKinds; ++kind) {
    for (int sigma = 0; sigma < kSigmaLevels; ++sigma) {
      const double sigma_px = kSmallestSigmaPx * std::pow(kSigmaRatio, sigma);
      for (int level = 0; level < OrientedDistanceField::kDensityLevels; ++level) {
        const double density = OrientedDistanceField::DensityOfLevel(level);
        for (int units = 0; units < kDistances; ++units) {
          *ratio++ = static_cast<float>(
              LineLogRatio(units, sigma_px, density, options.seen_share[kind]));
        }
      }
      ratio += kDistances;  // hidden: 0
    }
  }
}

int LineLikelihood::SigmaLevel(float inverse_depth) const {
  const float model_px = sigma_model_px_m_ * inverse_depth;
  const float sigma = std::sqrt(sigma_px_ * sigma_px_ + model_px * model_px);
  const float level = std::log(sigma / kSmallestSigmaPx) / std::log(kSigmaRatio);
  return std::clamp(static_cast<int>(level + 0.5f), 0, kSigmaLevels - 1);
}

std::array<float, kEdgeKinds> LineLikelihood::LogRatios(
    std::span<const ProjectedSegment> segments, std::span<const EdgeKind> kinds) const {
  std::array<float, kEdgeKinds> sums{};
  const float max_x = static_cast<float>(field_.width()) - 1.0f;
  const float max_y = static_cast<float>(field_.height()) - 1.0f;
  for (const ProjectedSegment& segment : segments) {
    const Eigen::Vector2f d = segment.b - segment.a;
    const float length = d.norm();
    const int samples = std::max(1, static_cast<int>(length / spacing_px_ + 0.5f));
    const int direction = OrientedDistanceField::DirectionOf(d.x(), d.y());
    const EdgeKind kind = kinds[segment.piece];
    const float step = 1.0f / static_cast<float>(samples);
    const int level_a = SigmaLevel(segment.inverse_depth_a);
    const int level_b = SigmaLevel(segment.inverse_depth_b);
    float partial = 0.0f;
    for (int i = 0; i < samples; ++i) {
      const float t = (static_cast<float>(i) + 0.5f) * step;
      const int x = static_cast<int>(std::clamp(segment.a.x() + t * d.x(), 0.0f, max_x));
      const int y = static_cast<int>(std::clamp(segment.a.y() + t * d.y(), 0.0f, max_y));
      const int level = static_cast<int>(static_cast<float>(level_a) +
                                         t * static_cast<float>(level_b - level_a) + 0.5f);
      partial += Table(kind, level, field_.DensityLevel(direction, x, y))[field_.Distance(direction, x, y)];
    }
    // A segment shorter than the spacing counts by its length.
    sums[static_cast<std::size_t>(kind)] +=
        partial * std::min(1.0f, length / (spacing_px_ * static_cast<float>(samples)));
  }
  return sums;
}

}  // namespace ridgeline
