// SPDX-License-Identifier: Apache-2.0
#include "score/area_score.h"

#include <cmath>

#include "score/score_plugin.h"

namespace ridgeline {
namespace {

// Surfaces whose normal rises more than this are roofs, whatever they are called.
constexpr float kRoofUpward = 0.25f;

bool IsBuilding(AreaClass c) {
  return c == AreaClass::kBuilding || c == AreaClass::kRoof || c == AreaClass::kWall;
}

// Intersection and union of one class.
struct Overlap {
  int both = 0;
  int either = 0;

  void Count(bool in_picture, bool in_model) {
    both += in_picture && in_model;
    either += in_picture || in_model;
  }
  double Share() const { return either == 0 ? 0.0 : static_cast<double>(both) / either; }
};

}  // namespace

AreaScore::AreaScore(const PictureEvidence& picture,
                     const CityModel& model,
                     const AreaOptions& options)
    : model_(model),
      by_colours_(options.source == "colours"),
      apart_(options.parts == "roof_wall") {
  const PinholeCamera grid =
      picture.camera().Scaled(static_cast<double>(options.columns) / picture.camera().width);
  const cv::Size cells(grid.width, grid.height);
  const cv::Mat areas = by_colours_ ? AreasOfColours(picture.bgr(), picture.foliage(), cells)
                                    : AreasOfFile(ReadClasses(options.file, picture.full_camera()),
                                                  options,
                                                  cells);
  bool any = false;
  for (int y = 0; y < grid.height; ++y) {
    for (int x = 0; x < grid.width; ++x) {
      rays_.push_back(grid.RayFromImage({x + 0.5, y + 0.5}).cast<float>());
      of_picture_.push_back(static_cast<AreaClass>(areas.at<std::uint8_t>(y, x)));
      any = any || IsBuilding(of_picture_.back());
    }
  }
  if (picture.is_blank()) {
    unusable_ = "the picture has one colour";
  } else if (!any) {
    unusable_ = "the picture shows no building";
  }
}

AreaClass AreaScore::ModelClass(const PositionView& view, const Eigen::Vector3f& direction) const {
  const std::uint32_t* const surface = view.surfaces.Find(direction);
  if (surface == nullptr) return AreaClass::kUnknown;
  // Beyond the model and the terrain the ground goes on to the horizon.
  if (*surface == kNoSurface) return direction.z() > 0.0f ? AreaClass::kSky : AreaClass::kGround;
  if (*surface == kTerrainSurface) return AreaClass::kGround;
  const Surface& hit = model_.surfaces[*surface];
  if (hit.surface_class == SurfaceClass::kGround || hit.surface_class == SurfaceClass::kTerrain) {
    return AreaClass::kGround;
  }
  return hit.normal.z() > kRoofUpward ? AreaClass::kRoof : AreaClass::kWall;
}

double AreaScore::LogRatio(const PositionView& view,
                           const Pose& cam_from_local,
                           Workspace& /*workspace*/) const {
  if (*unusable_ != '\0') return LogRatioOf(1.0);
  const Eigen::Matrix3f local_from_cam =
      cam_from_local.cam_from_world.toRotationMatrix().transpose().cast<float>();
  Overlap building, roof, wall;
  for (std::size_t i = 0; i < rays_.size(); ++i) {
    const AreaClass seen = of_picture_[i];
    if (seen == AreaClass::kUnknown) continue;
    const AreaClass model = ModelClass(view, (local_from_cam * rays_[i]).normalized());
    if (model == AreaClass::kUnknown || (by_colours_ && model == AreaClass::kGround)) continue;
    building.Count(IsBuilding(seen), IsBuilding(model));
    if (!apart_ || seen == AreaClass::kBuilding) continue;
    roof.Count(seen == AreaClass::kRoof, model == AreaClass::kRoof);
    wall.Count(seen == AreaClass::kWall, model == AreaClass::kWall);
  }
  return LogRatioOf(1.0 - (apart_ ? 0.5 * (roof.Share() + wall.Share()) : building.Share()));
}

extern const ScorePlugin kAreaScore;
constinit const ScorePlugin kAreaScore = {
    .name = kAreaScoreName,
    .declare = [](OptionGroups& options) { options.Add<AreaOptions>("areas"); },
    .make = [](const ScoreContext& c) -> std::unique_ptr<Score> {
      return std::make_unique<AreaScore>(
          c.picture, c.scene.model(), c.options.groups.Get<AreaOptions>());
    }};

}  // namespace ridgeline
