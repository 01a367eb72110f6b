// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "optim/simplex.h"

namespace ridgeline {

// True if the points differ by more than `distance` in some coordinate, the short way around in
// periodic ones.
bool Apart(const UnitPoint& a,
           const UnitPoint& b,
           const std::vector<bool>& periodic,
           double distance);

// The best vertices of finite energy, best first, at most `count`, each Apart() from the better
// ones.
std::vector<Vertex> BestApart(std::vector<Vertex> vertices,
                              std::size_t count,
                              double distance,
                              const std::vector<bool>& periodic);

}  // namespace ridgeline
