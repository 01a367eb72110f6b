// SPDX-License-Identifier: Apache-2.0
// Colours: what the regions sky, building and ground tell of them, and the buildings' facades and
// roofs among themselves (colour_information.h, with the sources). One look at the cells serves
// both.
#include <utility>

#include "score/colour_information.h"
#include "score/cue.h"

namespace ridgeline {
namespace {

// A grid over the picture.
struct Grid {
  std::shared_ptr<const ColourInformation> colours;
  float cells = 1.0f;  // of the grid asked for, that one of it stands for
};

Grid GridOf(const PictureEvidence& picture, const ColourOptions& options, float cells) {
  return {std::make_shared<ColourInformation>(
              picture.bgr(), picture.camera(), options, picture.foliage()),
          cells};
}

class ColourCues final : public Cue {
 public:
  // @param cam_from_level  Tilts under which it is quick.
  ColourCues(const PictureEvidence& picture,
             const ColourOptions& options,
             Grid grid,
             std::span<const Eigen::Matrix3f> cam_from_level)
      : picture_(picture),
        options_(options),
        grid_(std::move(grid)),
        rays_(grid_.colours->cell_rays(), cam_from_level) {}

  std::unique_ptr<Workspace> NewWorkspace() const override { return std::make_unique<Memory>(); }

  void LogRatios(const CuePose& pose,
                 Workspace* workspace,
                 std::span<float> log_ratios) const override {
    ColourInformation::Cues cues;
    if (!pose.view.surfaces.surfaces.empty()) {
      cues = CuesOf(pose, static_cast<Memory*>(workspace)->colours);
    }
    log_ratios[0] = static_cast<float>(cues.regions);
    // A cell tells as much as those that it stands for.
    log_ratios[1] = grid_.cells * static_cast<float>(cues.facades);
  }

  std::shared_ptr<const Cue> ForTilts(
      std::span<const Eigen::Matrix3f> cam_from_level) const override {
    return std::make_shared<ColourCues>(picture_, options_, grid_, cam_from_level);
  }

  static std::span<const Eigen::Matrix3f> NoTilts() { return {}; }

 private:
  struct Memory final : Workspace {
    ColourInformation::Workspace colours;
  };

  ColourInformation::Cues CuesOf(const CuePose& pose,
                                 ColourInformation::Workspace& workspace) const {
    const PositionView& view = pose.view;
    if (const auto turned = rays_.Find(pose.cam_from_local)) {
      return grid_.colours->Of(view.surfaces, view.groups, rays_, *turned, workspace);
    }
    return grid_.colours->Of(view.surfaces, view.groups, pose.cam_from_local, workspace);
  }

  const PictureEvidence& picture_;
  ColourOptions options_;
  Grid grid_;
  TiltedRays rays_;
};

constexpr CueName kNames[] = {{"regions", 29.8}, {"facade_colours", 0.0218}};

}  // namespace

extern const CuePlugin kColourCues;
constinit const CuePlugin kColourCues = {
    .names = kNames,
    .parts = {.edges_and_skyline = false, .surfaces = true},
    .declare = [](OptionGroups& options) { options.Add<ColourOptions>("colours"); },
    .make = [](const CueContext& c) -> std::shared_ptr<const Cue> {
      const auto& options = c.options.Get<ColourOptions>();
      return std::make_shared<ColourCues>(
          c.picture, options, GridOf(c.picture, options, 1.0f), ColourCues::NoTilts());
    }};

}  // namespace ridgeline
