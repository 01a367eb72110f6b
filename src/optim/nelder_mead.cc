// SPDX-License-Identifier: Apache-2.0
#include "optim/nelder_mead.h"

#include <algorithm>
#include <memory>
#include <numeric>
#include <sstream>

#include "optim/simplex.h"

namespace ridgeline {
namespace {

// Coordinates of a group: names with commas between them, or "*". Fixed parameters are left out.
std::vector<std::size_t> Coordinates(const std::string& group,
                                     const std::vector<std::string>& names) {
  std::vector<std::size_t> coordinates(names.size());
  std::iota(coordinates.begin(), coordinates.end(), std::size_t{0});
  if (group == "*") return coordinates;
  coordinates.clear();
  std::istringstream stream(group);
  for (std::string name; std::getline(stream, name, ',');) {
    const auto it = std::find(names.begin(), names.end(), name);
    if (it != names.end()) coordinates.push_back(it - names.begin());
  }
  return coordinates;
}

}  // namespace

SearchRoutine NelderMead(StrategyContext context, NelderMeadOptions options) {
  static const std::uint64_t kStage = HashText("optim.nelder_mead");
  Random random(context.seed, kStage);
  const auto anywhere = [&] { return UniformPoint(random, context.dimension); };
  UnitPoint start = context.start.empty() ? anywhere() : context.start;
  for (;;) {
    Batch first{{start}, {}, anywhere};
    co_yield first;
    const auto best = std::make_shared<Vertex>(Vertex{first.points[0], first.energies[0]});
    for (const double step : options.steps) {
      for (const std::string& group : options.groups) {
        const std::vector<std::size_t> coordinates = Coordinates(group, context.names);
        if (coordinates.empty()) continue;
        SearchRoutine simplex =
            Simplex(best, coordinates, context.periodic, step, options.convergence * step);
        while (Batch* batch = simplex.Next()) co_yield *batch;
      }
    }
    start = anywhere();
  }
}

}  // namespace ridgeline
