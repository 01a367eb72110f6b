// SPDX-License-Identifier: Apache-2.0
// The directions of lines on facades (facade_directions.h, with the source).
#include <utility>

#include "score/cue.h"
#include "score/facade_directions.h"
#include "score/facade_table.h"

namespace ridgeline {
namespace {

class FacadeCue final : public Cue {
 public:
  FacadeCue(const CityModel& model, std::shared_ptr<const FacadeDirections> directions)
      : model_(model), directions_(std::move(directions)) {}

  void LogRatios(const CuePose& pose,
                 Workspace* /*workspace*/,
                 std::span<float> log_ratios) const override {
    const SurfacePanorama& surfaces = pose.view.surfaces;
    log_ratios[0] = surfaces.surfaces.empty()
                        ? 0.0f
                        : directions_->LogRatio(surfaces, model_, pose.cam_from_local);
  }

  std::shared_ptr<const Cue> ForTilts(
      std::span<const Eigen::Matrix3f> cam_from_level) const override;

 private:
  const CityModel& model_;
  std::shared_ptr<const FacadeDirections> directions_;
};

// FacadeCue, quick under a few tilts.
class TiltedFacadeCue final : public Cue {
 public:
  TiltedFacadeCue(const CityModel& model,
                  const std::shared_ptr<const FacadeDirections>& directions,
                  std::span<const Eigen::Matrix3f> cam_from_level)
      : model_(model), general_(model, directions), table_(directions, cam_from_level) {}

  void LogRatios(const CuePose& pose,
                 Workspace* workspace,
                 std::span<float> log_ratios) const override {
    const auto turned = table_.Find(pose.cam_from_local);
    if (!turned || pose.view.surfaces.surfaces.empty()) {
      general_.LogRatios(pose, workspace, log_ratios);
      return;
    }
    log_ratios[0] = table_.LogRatio(pose.view, model_, pose.cam_from_local, *turned);
  }

 private:
  const CityModel& model_;
  FacadeCue general_;
  FacadeTable table_;
};

std::shared_ptr<const Cue> FacadeCue::ForTilts(
    std::span<const Eigen::Matrix3f> cam_from_level) const {
  return std::make_shared<TiltedFacadeCue>(model_, directions_, cam_from_level);
}

constexpr CueName kFacadeNames[] = {{"facades", 1.08}};

}  // namespace

extern const CuePlugin kFacadeCue;
constinit const CuePlugin kFacadeCue = {
    .names = kFacadeNames,
    .parts = {.edges_and_skyline = false, .surfaces = true},
    .declare = [](OptionGroups& options) { options.Add<FacadeDirectionOptions>("facades"); },
    .make = [](const CueContext& c) -> std::shared_ptr<const Cue> {
      return std::make_shared<FacadeCue>(
          c.scene.model(),
          std::make_shared<FacadeDirections>(c.picture.segments(),
                                             c.picture.camera(),
                                             c.options.Get<FacadeDirectionOptions>()));
    }};

}  // namespace ridgeline
