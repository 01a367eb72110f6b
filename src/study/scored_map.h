// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "camera/pose.h"
#include "localize/pose_space.h"
#include "localize/pose_volume.h"

namespace ridgeline {

// A dense map of a score with the error of each of its poses. Positions and orientations are apart:
// pose = position * orientations + orientation, as in PoseVolume.
struct ScoredMap {
  PoseVolume volume;
  std::vector<char> admissible;       // by position
  std::vector<double> translation_m;  // error, by position
  std::vector<double> rotation_deg;   // error, by orientation

  std::size_t positions() const { return admissible.size(); }
  std::size_t poses() const { return volume.log_ratios.size(); }
  bool Admissible(std::size_t pose) const { return admissible[pose / volume.orientations()]; }
  double TranslationM(std::size_t pose) const {
    return translation_m[pose / volume.orientations()];
  }
  double RotationDeg(std::size_t pose) const { return rotation_deg[pose % volume.orientations()]; }
};

// @param truth_in_local  In the model's local frame, as the space.
ScoredMap WithErrors(PoseVolume volume, const PoseSpace& space, const Pose& truth_in_local);

// Place of a pose in the grid: height, north, east, heading, tilt.
using GridPlace = std::array<int, 5>;
GridPlace SizesOf(const PoseVolume& volume);
GridPlace PlaceOf(const PoseVolume& volume, std::size_t pose);

// The best of the poses beside a pose in the grid (up to 3^5 - 1), or the pose itself if none is
// better. A heading that goes all around has no end.
std::size_t BestNeighbour(const PoseVolume& volume, std::size_t pose);

}  // namespace ridgeline
