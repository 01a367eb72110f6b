// SPDX-License-Identifier: Apache-2.0
// The directions of lines on facades (facade_directions.h, with the source).
#include "score/cue.h"
#include "score/facade_directions.h"

namespace ridgeline {
namespace {

class FacadeCue final : public Cue {
 public:
  FacadeCue(const PictureEvidence& picture,
            const CityModel& model,
            const FacadeDirectionOptions& options)
      : model_(model), directions_(picture.segments(), picture.camera(), options) {}

  void LogRatios(const CuePose& pose,
                 Workspace* /*workspace*/,
                 std::span<float> log_ratios) const override {
    const SurfacePanorama& surfaces = pose.view.surfaces;
    log_ratios[0] = surfaces.surfaces.empty()
                        ? 0.0f
                        : directions_.LogRatio(surfaces, model_, pose.cam_from_local);
  }

 private:
  const CityModel& model_;
  FacadeDirections directions_;
};

constexpr CueName kNames[] = {{"facades", 1.08}};

}  // namespace

extern const CuePlugin kFacadeCue;
constinit const CuePlugin kFacadeCue = {
    .names = kNames,
    .parts = {.edges_and_skyline = false, .surfaces = true},
    .declare = [](OptionGroups& options) { options.Add<FacadeDirectionOptions>("facades"); },
    .make = [](const CueContext& c) -> std::shared_ptr<const Cue> {
      return std::make_shared<FacadeCue>(
          c.picture, c.scene.model(), c.options.Get<FacadeDirectionOptions>());
    }};

}  // namespace ridgeline
