// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <vector>

#include "camera/intrinsics.h"
#include "camera/pose.h"
#include "projection/scene.h"
#include "score/position_view.h"
#include "score/score.h"

namespace ridgeline::python {

// Poses of one place, next to each other in the order of PlacesOf().
struct PlaceGroup {
  std::size_t first = 0;
  std::size_t count = 0;
};

// Poses ordered by place, and the groups of equal places.
struct PoseGroups {
  std::vector<std::size_t> order;  // indices into the poses
  std::vector<Pose> poses;         // in that order
  std::vector<PlaceGroup> places;
};
PoseGroups GroupsOf(std::span<const Pose> poses);

// Looks from every place once, in parallel, and calls judge(view, poses of the place, their
// indices, workspace) with what is seen from it.
using JudgePlace = std::function<void(const PositionView& view,
                                      std::span<const Pose> poses,
                                      std::span<const std::size_t> indices,
                                      Score::Workspace& workspace)>;
void ForEachPlace(const Score& score,
                  const Scene& scene,
                  const PinholeCamera& camera,
                  double surface_step_deg,
                  const PoseGroups& groups,
                  int threads,
                  const JudgePlace& judge);

}  // namespace ridgeline::python
