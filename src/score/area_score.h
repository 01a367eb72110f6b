// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "camera/intrinsics.h"
#include "score/area_classes.h"
#include "score/picture_evidence.h"
#include "score/score.h"

namespace ridgeline {

// Areas of buildings in a picture against those that the model shows from a pose (the outlook of
// Loeper et al., section 7). The energy is 1 minus the intersection over the union of the buildings,
// or, with parts "roof_wall", 1 minus the mean over roofs and walls. Cells where the picture is not
// known do not count; by colours, those where the model shows ground do not either, since colours do
// not tell ground from walls.
class AreaScore final : public Score {
 public:
  // Throws InputError for source "file" as ReadClasses().
  AreaScore(const PictureEvidence& picture, const CityModel& model, const AreaOptions& options);

  ViewParts parts() const override { return {false, true}; }
  const char* unusable() const override { return unusable_; }
  double LogRatio(const PositionView& view,
                  const Pose& cam_from_local,
                  Workspace& workspace) const override;

 private:
  AreaClass ModelClass(const PositionView& view, const Eigen::Vector3f& direction) const;

  const CityModel& model_;
  const bool by_colours_;
  const bool apart_;  // roofs and walls
  const char* unusable_ = "";
  std::vector<Eigen::Vector3f> rays_;   // camera axes, through the cells' centres
  std::vector<AreaClass> of_picture_;  // by cell
};

}  // namespace ridgeline
