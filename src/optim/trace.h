// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <vector>

#include "optim/search_box.h"
#include "optim/trial.h"

namespace ridgeline {

// All trials of a search, in the order of their index.
struct Trace {
  std::vector<Trial> trials;

  // The complete trial of least energy, the first of equals; nullptr if no trial is complete.
  const Trial* Best() const;
  // Least energy among the first `count` trials; +infinity if none is complete.
  double BestEnergyAfter(std::size_t count) const;
};

// JSON lines: a header with the box, then one trial per line:
//   {"ridgeline_trace":1,"parameters":[{"name":"heading_deg","lower":0.0,"upper":360.0,...}]}
//   {"index":0,"values":[12.5],"energy":0.71,"state":"complete"}
// Numbers keep all their bits. The file appears whole or not at all.
void WriteTrace(const std::filesystem::path& path, const SearchBox& box, const Trace& trace);

// Throws InputError with file and line for a file that is not a trace of this box.
Trace ReadTrace(const std::filesystem::path& path, const SearchBox& box);

}  // namespace ridgeline
