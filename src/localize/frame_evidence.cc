// SPDX-License-Identifier: Apache-2.0
#include "localize/frame_evidence.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <utility>

#include "base/error.h"
#include "base/parallel.h"
#include "localize/pose_scorer.h"
#include "localize/search_poses.h"
#include "score/score_table.h"

namespace ridgeline {
namespace {

// Directions that share one view.
constexpr double kHeadingCellDeg = 20.0;
// A camera below this above the terrain is in the ground.
constexpr double kMinAboveTerrainM = 0.2;

const LocalizationInput& Checked(const LocalizationInput& input) {
  if (input.picture.cols == input.camera.width && input.picture.rows == input.camera.height) {
    return input;
  }
  throw InputError("",
                   "image",
                   std::to_string(input.picture.cols) + " x " + std::to_string(input.picture.rows),
                   "the camera's " + std::to_string(input.camera.width) + " x " +
                       std::to_string(input.camera.height));
}

// Poses that are looked at from one place, in about one direction.
using Cell = std::array<long, 4>;

Cell CellOf(const Pose& pose, double cell_m) {
  const Eigen::Vector3d& p = pose.center_in_world;
  return {std::lround(p.x() / cell_m),
          std::lround(p.y() / cell_m),
          std::lround(p.z() / cell_m),
          std::lround(ViewAnglesOf(pose.cam_from_world).heading_deg / kHeadingCellDeg)};
}

}  // namespace

struct FrameEvidence::Impl {
  Impl(const Localizer& from, const LocalizationInput& input, int threads)
      : localizer(from),
        picture(UndistortImage(BgrOf(input.picture), input.camera),
                input.camera.Pinhole(),
                from.options().lines,
                from.options().score.evidence,
                threads,
                input.lines),
        score(MakeScore({picture, from.scene(), from.options().score})),
        surface_step_rad(from.options().score.evidence.surface_step_deg * std::numbers::pi /
                         180.0) {
    unusable = TooFewLines(picture.segments().size());
    if (unusable.empty()) unusable = score->unusable();
  }

  // A view from the middle of the places for all of their orientations.
  PositionView ViewOf(std::span<const Pose> poses, const std::vector<std::size_t>& members) const {
    Eigen::Vector3d middle = Eigen::Vector3d::Zero();
    const ViewAngles center = ViewAnglesOf(poses[members.front()].cam_from_world);
    ViewAngles half;
    for (const std::size_t i : members) {
      middle += poses[i].center_in_world / static_cast<double>(members.size());
      const ViewAngles angles = ViewAnglesOf(poses[i].cam_from_world);
      half.heading_deg = std::max(
          half.heading_deg, std::abs(HeadingDifferenceDeg(angles.heading_deg, center.heading_deg)));
      half.pitch_deg = std::max(half.pitch_deg, std::abs(angles.pitch_deg - center.pitch_deg));
      half.roll_deg = std::max(half.roll_deg, std::abs(angles.roll_deg - center.roll_deg));
    }
    return ViewFrom(localizer.scene(),
                    middle,
                    RangeOf(picture.camera(), center, half, surface_step_rad),
                    score->parts());
  }

  const Localizer& localizer;
  PictureEvidence picture;
  std::unique_ptr<Score> score;
  double surface_step_rad;
  std::string unusable;
};

FrameEvidence::FrameEvidence(const Localizer& localizer,
                             const LocalizationInput& input,
                             int threads)
    : impl_(std::make_unique<Impl>(localizer, Checked(input), threads)) {}
FrameEvidence::~FrameEvidence() = default;
FrameEvidence::FrameEvidence(FrameEvidence&&) noexcept = default;

const std::string& FrameEvidence::unusable() const { return impl_->unusable; }

FrameEvidence::Modes FrameEvidence::Search(const PosePrior& prior,
                                           const PoseSpaceOptions& ranges,
                                           std::uint64_t seed,
                                           int threads) const {
  Modes result;
  if (!unusable().empty()) return result;
  const Localizer& localizer = impl_->localizer;
  const PoseSpace space(
      prior, ranges, localizer.scene(), localizer.dtm(), localizer.footprints());
  const LocalizerOptions& options = localizer.options();
  const PoseScorer scorer(*impl_->score,
                          localizer.scene(),
                          space,
                          impl_->picture.camera(),
                          options.score.evidence.surface_step_deg);
  SearchedPoses found = SearchPoses(scorer, impl_->picture, options.search, seed, threads);
  result.evaluations = found.evaluations;
  if (found.volume) result.map = MapOf(*found.volume, space, localizer.scene().model());
  if (found.modes.empty()) return result;
  if (options.search.refine) result.evaluations += RefineModes(scorer, threads, found);
  for (const ScoredPose& mode : found.modes) {
    const std::optional<Pose> pose = space.PoseAt(mode.offset);
    if (pose) result.modes.push_back({*pose, mode.log_ratio - space.LogPrior(mode.offset)});
  }
  return result;
}

std::vector<double> FrameEvidence::LogRatios(std::span<const Pose> cam_from_local,
                                             double cell_m,
                                             int threads) const {
  constexpr double kNothing = -std::numeric_limits<double>::infinity();
  std::vector<double> log_ratios(cam_from_local.size(), kNothing);
  if (!unusable().empty()) return log_ratios;
  std::map<Cell, std::vector<std::size_t>> by_cell;
  for (std::size_t i = 0; i < cam_from_local.size(); ++i) {
    by_cell[CellOf(cam_from_local[i], cell_m)].push_back(i);
  }
  std::vector<const std::vector<std::size_t>*> cells;
  for (const auto& [cell, members] : by_cell) cells.push_back(&members);
  ParallelFor(cells.size(), threads, [&](std::size_t c) {
    std::vector<std::size_t> members;
    for (const std::size_t i : *cells[c]) {
      if (IsAdmissible(cam_from_local[i].center_in_world)) members.push_back(i);
    }
    if (members.empty()) return;
    const PositionView view = impl_->ViewOf(cam_from_local, members);
    const std::unique_ptr<Score::Workspace> workspace = impl_->score->NewWorkspace();
    for (const std::size_t i : members) {
      log_ratios[i] = impl_->score->LogRatio(view, cam_from_local[i], *workspace);
    }
  });
  return log_ratios;
}

Goodness FrameEvidence::GoodnessAt(const Pose& cam_from_local) const {
  if (!unusable().empty()) return {};
  PosePrior prior;
  const Localizer& localizer = impl_->localizer;
  const ViewAngles angles = ViewAnglesOf(cam_from_local.cam_from_world);
  const Eigen::Vector3d place =
      cam_from_local.center_in_world + localizer.scene().model().origin_in_world;
  prior.position_in_world = place.head<2>();
  prior.height_in_world = place.z();
  prior.heading_deg = angles.heading_deg;
  prior.pitch_deg = angles.pitch_deg;
  prior.roll_deg = angles.roll_deg;
  PoseSpaceOptions fixed{0.0, 0.0, 0.0, 0.0, 0.0, 0.0};
  const PoseSpace space(prior, fixed, localizer.scene(), localizer.dtm(), localizer.footprints());
  return GoodnessOf(PoseScorer(*impl_->score,
                               localizer.scene(),
                               space,
                               impl_->picture.camera(),
                               localizer.options().score.evidence.surface_step_deg),
                    {});
}

bool FrameEvidence::IsAdmissible(const Eigen::Vector3d& position) const {
  const Localizer& localizer = impl_->localizer;
  if (const HeightGrid* dtm = localizer.dtm()) {
    const std::optional<double> ground = dtm->HeightAt(position.head<2>());
    if (!ground || position.z() < *ground + kMinAboveTerrainM) return false;
  }
  return !(localizer.footprints().Contains(position.head<2>()) &&
           localizer.scene().Raycast(position, Eigen::Vector3d::UnitZ()));
}

}  // namespace ridgeline
