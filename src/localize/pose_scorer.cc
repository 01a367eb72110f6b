// SPDX-License-Identifier: Apache-2.0
#include "localize/pose_scorer.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace ridgeline {

PoseScorer::PoseScorer(const Score& score,
                       const Scene& scene,
                       const PoseSpace& space,
                       const PinholeCamera& camera,
                       double surface_step_deg)
    : score_(&score),
      scene_(&scene),
      space_(&space),
      camera_(&camera),
      surface_step_rad_(surface_step_deg * std::numbers::pi / 180.0) {}

PoseScorer PoseScorer::With(const Score& score) const {
  PoseScorer other = *this;
  other.score_ = &score;
  return other;
}

PoseScorer PoseScorer::In(const PoseSpace& space) const {
  PoseScorer other = *this;
  other.space_ = &space;
  return other;
}

PanoramaRange PoseScorer::RangeAround(const ViewAngles& center,
                                      const ViewAngles& half_ranges) const {
  return RangeOf(*camera_, center, half_ranges, surface_step_rad_);
}

PanoramaRange PoseScorer::RangeOver(std::span<const PoseSpace::Offset> offsets) const {
  const ViewAngles center = space_->AnglesAt(offsets[offsets.size() / 2]);
  ViewAngles half_ranges;
  for (const PoseSpace::Offset& offset : offsets) {
    const ViewAngles angles = space_->AnglesAt(offset);
    const auto widen = [](double& half_range, double difference) {
      half_range = std::max(half_range, std::abs(difference));
    };
    widen(half_ranges.heading_deg, HeadingDifferenceDeg(angles.heading_deg, center.heading_deg));
    widen(half_ranges.pitch_deg, angles.pitch_deg - center.pitch_deg);
    widen(half_ranges.roll_deg, angles.roll_deg - center.roll_deg);
  }
  return RangeAround(center, half_ranges);
}

Orientations PoseScorer::OrientationsOf(std::span<const PoseSpace::Offset> offsets) const {
  Orientations orientations;
  for (const PoseSpace::Offset& offset : offsets) {
    orientations.cam_from_local.push_back(CamFromWorld(space_->AnglesAt(offset)));
    orientations.log_priors.push_back(space_->LogPrior(offset));
  }
  return orientations;
}

std::optional<double> PoseScorer::LogRatioAt(const PoseSpace::Offset& offset) const {
  const auto position = space_->PositionAt(offset.east_m, offset.north_m, offset.height_m);
  if (!position) return std::nullopt;
  Look look(*this);
  look.From(*position, RangeAround(space_->AnglesAt(offset), {}));
  return look.LogRatio(*position, offset);
}

PoseScorer::Look::Look(const PoseScorer& scorer)
    : scorer_(scorer), workspace_(scorer.score_->NewWorkspace()) {}

void PoseScorer::Look::From(const Eigen::Vector3d& position, const PanoramaRange& range) {
  position_ = position;
  view_ = ViewFrom(*scorer_.scene_, position, range, scorer_.score_->parts());
}

double PoseScorer::Look::PictureLogRatio(const Pose& cam_from_local) {
  return scorer_.score_->LogRatio(view_, cam_from_local, *workspace_);
}

double PoseScorer::Look::LogRatio(const Eigen::Vector3d& position,
                                  const PoseSpace::Offset& offset) {
  const PoseSpace& space = *scorer_.space_;
  return PictureLogRatio({CamFromWorld(space.AnglesAt(offset)), position}) + space.LogPrior(offset);
}

std::span<const double> PoseScorer::Look::LogRatios(const Orientations& orientations) {
  const std::size_t count = orientations.cam_from_local.size();
  poses_.resize(count);
  log_ratios_.resize(count);
  for (std::size_t i = 0; i < count; ++i) {
    poses_[i] = {orientations.cam_from_local[i], position_};
  }
  scorer_.score_->LogRatios(view_, poses_, *workspace_, log_ratios_);
  for (std::size_t i = 0; i < count; ++i) log_ratios_[i] += orientations.log_priors[i];
  return log_ratios_;
}

}  // namespace ridgeline
