// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace ridgeline {

// How well the edges of one building are seen from one pose, in weighted nats of the line
// likelihood.
struct BuildingFit {
  std::uint32_t building = 0;  // index into CityModel::buildings
  double observed = 0.0;       // log likelihood ratio of the picture's lines
  double expected = 0.0;       // what it is on average where the pose and the model are right
  double chance = 0.0;         // what it is on average where the edges lie anywhere; below 0
  double length_px = 0.0;      // of the edges in the picture
  // The height that the roof would have to be raised by [m], the likeliest of +- 2 m, and the log
  // likelihood ratio gained by it; 0 where the edges do not tell.
  double roof_shift_m = 0.0;
  double roof_gain = 0.0;

  // Nats that tell a right pose from any other.
  double information() const { return expected - chance; }
  // 1 where the edges are seen as on average they should be, 0 where they might lie anywhere.
  double explained() const {
    return information() > 0.0 ? (observed - chance) / information() : 0.0;
  }
};

}  // namespace ridgeline
