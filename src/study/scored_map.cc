// SPDX-License-Identifier: Apache-2.0
#include "study/scored_map.h"

#include <algorithm>
#include <cmath>

namespace ridgeline {
namespace {

bool GoesAround(const std::vector<double>& heading_deg) {
  if (heading_deg.size() < 3) return false;
  const double step = heading_deg[1] - heading_deg[0];
  return heading_deg.back() - heading_deg.front() + step > 360.0 - 0.5 * step;
}

}  // namespace

ScoredMap WithErrors(PoseVolume volume, const PoseSpace& space, const Pose& truth_in_local) {
  ScoredMap map;
  map.volume = std::move(volume);
  const PoseVolume& v = map.volume;
  const ViewAngles& center = space.center_angles();
  for (std::size_t i = 0; i < v.orientations(); ++i) {
    map.rotation_deg.push_back(RotationDistanceDeg(
        CamFromWorld(space.AnglesAt(v.OffsetOf(i, center))), truth_in_local.cam_from_world));
  }
  for (std::size_t first = 0; first < v.log_ratios.size(); first += v.orientations()) {
    const PoseSpace::Offset offset = v.OffsetOf(first, center);
    const auto position = space.PositionAt(offset.east_m, offset.north_m, offset.height_m);
    map.admissible.push_back(position ? 1 : 0);
    map.translation_m.push_back(position ? (*position - truth_in_local.center_in_world).norm()
                                         : INFINITY);
  }
  return map;
}

GridPlace SizesOf(const PoseVolume& volume) {
  return {static_cast<int>(volume.height_m.size()),
          static_cast<int>(volume.north_m.size()),
          static_cast<int>(volume.east_m.size()),
          static_cast<int>(volume.heading_deg.size()),
          static_cast<int>(volume.tilts.size())};
}

GridPlace PlaceOf(const PoseVolume& volume, std::size_t pose) {
  const GridPlace sizes = SizesOf(volume);
  GridPlace place{};
  for (int k = 4; k >= 0; --k) {
    place[k] = static_cast<int>(pose % sizes[k]);
    pose /= sizes[k];
  }
  return place;
}

std::size_t BestNeighbour(const PoseVolume& volume, std::size_t pose) {
  const GridPlace sizes = SizesOf(volume);
  const GridPlace place = PlaceOf(volume, pose);
  const bool around = GoesAround(volume.heading_deg);
  std::size_t best = pose;
  for (int code = 0; code < 243; ++code) {  // 3^5 steps of -1, 0, 1 in each direction
    std::size_t index = 0;
    bool inside = true;
    int rest = code;
    for (int k = 0; k < 5 && inside; ++k, rest /= 3) {
      int at = place[k] + rest % 3 - 1;
      if (k == 3 && around) at = (at + sizes[k]) % sizes[k];
      inside = at >= 0 && at < sizes[k];
      index = index * sizes[k] + at;
    }
    if (inside && volume.log_ratios[index] > volume.log_ratios[best]) best = index;
  }
  return best;
}

}  // namespace ridgeline
