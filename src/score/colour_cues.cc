// SPDX-License-Identifier: Apache-2.0
// Colours: what the regions sky, building and ground tell of them, and the buildings' facades and
// roofs among themselves (colour_information.h, with the sources). One look at the cells serves
// both.
#include "score/colour_information.h"
#include "score/cue.h"

namespace ridgeline {
namespace {

class ColourCues final : public Cue {
 public:
  ColourCues(const PictureEvidence& picture, const ColourOptions& options)
      : colours_(picture.bgr(), picture.camera(), options, picture.foliage()) {}

  std::unique_ptr<Workspace> NewWorkspace() const override { return std::make_unique<Memory>(); }

  void LogRatios(const CuePose& pose,
                 Workspace* workspace,
                 std::span<float> log_ratios) const override {
    ColourInformation::Cues cues;
    if (!pose.view.surfaces.surfaces.empty()) {
      cues = colours_.Of(pose.view.surfaces,
                         pose.view.groups,
                         pose.cam_from_local,
                         static_cast<Memory*>(workspace)->colours);
    }
    log_ratios[0] = static_cast<float>(cues.regions);
    log_ratios[1] = static_cast<float>(cues.facades);
  }

 private:
  struct Memory final : Workspace {
    ColourInformation::Workspace colours;
  };

  ColourInformation colours_;
};

constexpr CueName kNames[] = {{"regions", 29.8}, {"facade_colours", 0.0218}};

}  // namespace

extern const CuePlugin kColourCues;
constinit const CuePlugin kColourCues = {
    .names = kNames,
    .parts = {.edges_and_skyline = false, .surfaces = true},
    .declare = [](OptionGroups& options) { options.Add<ColourOptions>("colours"); },
    .make = [](const CueContext& c) -> std::shared_ptr<const Cue> {
      return std::make_shared<ColourCues>(c.picture, c.options.Get<ColourOptions>());
    }};

}  // namespace ridgeline
