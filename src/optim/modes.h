// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "optim/search_box.h"
#include "optim/trace.h"

namespace ridgeline {

// A place that is better than all around it.
struct Mode {
  std::int64_t trial = 0;  // its index in the trace
  std::vector<double> values;
  double energy = 0.0;
};

struct DistinctModesOptions {
  // Per parameter of the box, in its unit, >= 0: two points are neighbours if no parameter differs
  // by more than this (across the seam of periodic parameters). 0 for parameters that are fixed;
  // +infinity for those that shall not tell modes apart.
  std::vector<double> separation;
  // Most modes returned, > 0.
  int max_modes = 10;

  // Throws InputError naming the field.
  void Validate(const SearchBox& box) const;
};

// The distinct best places of a search, best first: the complete trials that have no better
// neighbour (of equals, the first). So no two modes are neighbours, and the slope of a deep basin
// is not a mode however wide the basin is, as far as the search has looked there.
// At most O(n^2), usually far less.
std::vector<Mode> DistinctModes(const Trace& trace,
                                const SearchBox& box,
                                const DistinctModesOptions& options);

}  // namespace ridgeline
