// SPDX-License-Identifier: Apache-2.0
#include "score/skyline_l1.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "score/sky_score.h"
#include "skyline/clean_skyline.h"

namespace ridgeline {
namespace {

SkylineUse UseOf(const Skyline& real, double min_known_share) {
  std::size_t seen = 0, known = 0;
  for (const SkylineColumn c : real.columns) {
    if (c != SkylineColumn::kUnknown) ++known;
    if (c == SkylineColumn::kSeen || c == SkylineColumn::kBelowImage) ++seen;
  }
  if (seen == 0) return SkylineUse::kNoSky;
  const double least = min_known_share * static_cast<double>(real.size());
  return static_cast<double>(std::min(known, seen)) < least ? SkylineUse::kTooFewKnown
                                                            : SkylineUse::kUsable;
}

}  // namespace

const char* ReasonOf(SkylineUse use) {
  switch (use) {
    case SkylineUse::kUsable:
      return "usable";
    case SkylineUse::kNoSky:
      return "no sky in the picture";
    case SkylineUse::kTooFewKnown:
      return "the skyline is known in too few columns";
  }
  return "";
}

std::vector<Eigen::Vector3f> SkylineDirections(const VisibleSet& visible) {
  std::vector<Eigen::Vector3f> directions;
  directions.reserve(visible.skyline_elevation.size());
  double azimuth = visible.first_azimuth;
  for (const float elevation : visible.skyline_elevation) {
    const double level = std::cos(elevation);
    directions.emplace_back(static_cast<float>(level * std::sin(azimuth)),
                            static_cast<float>(level * std::cos(azimuth)),
                            std::sin(elevation));
    azimuth += visible.azimuth_step;
  }
  return directions;
}

SkylineL1::SkylineL1(const Skyline& real,
                     const PinholeCamera& camera,
                     const SkylineL1Options& options)
    : use_(UseOf(real, options.min_known_share)),
      camera_(camera.Scaled(static_cast<double>(options.columns) / camera.width)),
      half_energy_px_(options.half_energy_px) {
  px_scale_ = static_cast<float>(kSkylineReferenceWidthPx / camera_.width);
  max_deviation_ = static_cast<float>(options.max_deviation_px) / px_scale_;
  max_obstructed_ = static_cast<float>(options.max_obstructed_px) / px_scale_;
  if (!options.robust) max_deviation_ = max_obstructed_ = static_cast<float>(camera_.height);
  const Skyline clean =
      CleanSkyline(real, options.precision_px * real.image_width / kSkylineReferenceWidthPx);
  const double column_px = static_cast<double>(real.image_width) / camera_.width;
  const float row_scale =
      static_cast<float>(camera_.height) / static_cast<float>(real.image_height);
  for (int c = 0; c < camera_.width; ++c) {
    const double x = (c + 0.5) * column_px;
    const std::size_t k =
        std::min(clean.size() - 1, static_cast<std::size_t>(x / clean.column_step_px));
    rows_.push_back(clean.y_px[k] * row_scale);
    weights_.push_back(options.robust ? clean.confidence[k] : 1.0f);
    weight_sum_ += weights_.back();
  }
}

double SkylineL1::Distance(std::span<const Eigen::Vector3f> directions,
                           const Eigen::Matrix3f& cam_from_world) const {
  std::array<float, SkylineL1Options::kMaxColumns> rows;
  const std::span<float> used(rows.data(), rows_.size());
  SkylineRows(directions, camera_, cam_from_world, used);
  return DistanceOfRows(used);
}

double SkylineL1::DistanceOfRows(std::span<const float> rows) const {
  if (weight_sum_ <= 0.0) return max_deviation_ * px_scale_;
  const float bottom = static_cast<float>(camera_.height);
  float sum = 0.0f;
  for (std::size_t c = 0; c < rows_.size(); ++c) {
    float deviation = max_deviation_;
    if (!std::isnan(rows[c])) {
      const float below = std::clamp(rows[c], 0.0f, bottom) - rows_[c];
      deviation =
          below > 0.0f ? std::min(below, max_obstructed_) : std::min(-below, max_deviation_);
    }
    sum += weights_[c] * deviation;
  }
  return sum / weight_sum_ * px_scale_;
}

double SkylineL1::Energy(double distance_px) const {
  if (use_ != SkylineUse::kUsable) return 1.0;
  return distance_px / (distance_px + half_energy_px_);
}

}  // namespace ridgeline
