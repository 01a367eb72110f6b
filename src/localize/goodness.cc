// SPDX-License-Identifier: Apache-2.0
#include "localize/goodness.h"

#include <algorithm>

namespace ridgeline {

Goodness GoodnessOf(const PoseScorer& scorer, const PoseSpace::Offset& offset) {
  const PoseSpace& space = scorer.space();
  const std::optional<Pose> pose = space.PoseAt(offset);
  if (!pose) return {};
  PoseScorer::Look look(scorer);
  look.From(pose->center_in_world, scorer.RangeAround(space.AnglesAt(offset), {}));
  Goodness goodness;
  goodness.buildings = scorer.score().BuildingFits(look.view(), *pose, look.workspace());
  for (const BuildingFit& fit : goodness.buildings) {
    goodness.observed += fit.observed;
    goodness.expected += fit.expected;
    goodness.chance += fit.chance;
  }
  std::stable_sort(goodness.buildings.begin(),
                   goodness.buildings.end(),
                   [](const BuildingFit& a, const BuildingFit& b) {
                     return a.information() > b.information();
                   });
  return goodness;
}

}  // namespace ridgeline
