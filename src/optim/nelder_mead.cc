// SPDX-License-Identifier: Apache-2.0
#include "optim/nelder_mead.h"

#include <algorithm>
#include <memory>
#include <numeric>
#include <sstream>

#include "base/error.h"
#include "optim/batch_search.h"
#include "optim/sampler_plugin.h"
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

// Names in the groups of variables must be the box's; else a misspelt one would never be searched.
void ValidateGroups(const NelderMeadOptions& options, std::vector<std::string> known) {
  known.emplace_back("*");
  for (const std::string& group : options.groups) {
    std::istringstream stream(group);
    for (std::string name; std::getline(stream, name, ',');) {
      if (std::find(known.begin(), known.end(), name) != known.end()) continue;
      throw InputError("",
                       "sampler.nelder_mead.groups",
                       "\"" + name + "\"",
                       "a parameter, e.g. \"" + NearestName(name, known) + "\"");
    }
  }
}

}  // namespace

void NelderMeadOptions::Visit(OptionVisitor& v) {
  v.Field("steps", steps, Open(0.0, 1.0));
  v.Field("groups", groups);
  v.Rule("steps", !steps.empty(), "no steps", "at least one");
  v.Rule("groups", !groups.empty(), "no groups", "at least one, e.g. \"*\"");
  v.Field("convergence", convergence, Open(0.0, 1.0));
}

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

extern const SamplerPlugin kNelderMeadSampler;
constinit const SamplerPlugin kNelderMeadSampler = {
    .name = "nelder_mead",
    .declare = [](OptionGroups& options) { options.Add<NelderMeadOptions>("nelder_mead"); },
    .begins_at_start = true,
    .make = [](const StrategyContext& context,
               const OptionGroups& options) -> std::unique_ptr<Strategy> {
      ValidateGroups(options.Get<NelderMeadOptions>(), context.parameters);
      return std::make_unique<BatchStrategy>(NelderMead(context, options.Get<NelderMeadOptions>()));
    }};

}  // namespace ridgeline
