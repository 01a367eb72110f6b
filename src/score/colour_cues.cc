// SPDX-License-Identifier: Apache-2.0
// Colours: what the regions sky, building and ground tell of them, and the buildings' facades and
// roofs among themselves (colour_information.h, with the sources). One look at the cells serves
// both.
#include <utility>

#include "score/colour_information.h"
#include "score/cue.h"

namespace ridgeline {
namespace {

class ColourCues final : public Cue {
 public:
  explicit ColourCues(std::shared_ptr<const ColourInformation> colours)
      : colours_(std::move(colours)) {}

  // Quick under some tilts.
  ColourCues(std::shared_ptr<const ColourInformation> colours,
             std::span<const Eigen::Matrix3f> cam_from_level)
      : colours_(std::move(colours)), rays_(colours_->cell_rays(), cam_from_level) {}

  std::unique_ptr<Workspace> NewWorkspace() const override { return std::make_unique<Memory>(); }

  void LogRatios(const CuePose& pose,
                 Workspace* workspace,
                 std::span<float> log_ratios) const override {
    ColourInformation::Cues cues;
    if (!pose.view.surfaces.surfaces.empty()) {
      cues = CuesOf(pose, static_cast<Memory*>(workspace)->colours);
    }
    log_ratios[0] = static_cast<float>(cues.regions);
    log_ratios[1] = static_cast<float>(cues.facades);
  }

  std::shared_ptr<const Cue> ForTilts(
      std::span<const Eigen::Matrix3f> cam_from_level) const override {
    return std::make_shared<ColourCues>(colours_, cam_from_level);
  }

 private:
  struct Memory final : Workspace {
    ColourInformation::Workspace colours;
  };

  ColourInformation::Cues CuesOf(const CuePose& pose,
                                 ColourInformation::Workspace& workspace) const {
    const PositionView& view = pose.view;
    if (const auto turned = rays_.Find(pose.cam_from_local)) {
      return colours_->Of(view.surfaces, view.groups, rays_, *turned, workspace);
    }
    return colours_->Of(view.surfaces, view.groups, pose.cam_from_local, workspace);
  }

  std::shared_ptr<const ColourInformation> colours_;
  TiltedRays rays_{{}, {}};
};

constexpr CueName kColourNames[] = {{"regions", 29.8}, {"facade_colours", 0.0218}};

}  // namespace

extern const CuePlugin kColourCues;
constinit const CuePlugin kColourCues = {
    .names = kColourNames,
    .parts = {.edges_and_skyline = false, .surfaces = true},
    .declare = [](OptionGroups& options) { options.Add<ColourOptions>("colours"); },
    .make = [](const CueContext& c) -> std::shared_ptr<const Cue> {
      return std::make_shared<ColourCues>(
          std::make_shared<ColourInformation>(c.picture.bgr(),
                                              c.picture.camera(),
                                              c.options.Get<ColourOptions>(),
                                              c.picture.foliage()));
    }};

}  // namespace ridgeline
