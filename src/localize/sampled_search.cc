// SPDX-License-Identifier: Apache-2.0
#include "localize/sampled_search.h"

#include <limits>

#include "optim/minimize.h"
#include "optim/modes.h"

namespace ridgeline {
namespace {

PoseSpace::Offset OffsetOf(std::span<const double> values) {
  return {values[0], values[1], values[2], values[3], values[4], values[5]};
}

}  // namespace

SearchBox SearchBoxOf(const PoseSpace& space) {
  const PoseSpaceOptions& ranges = space.ranges();
  const auto parameter = [](const char* name, double half_range) {
    return Parameter{name, -half_range, half_range, false};
  };
  SearchBox box{{parameter("east_m", ranges.east_m),
                 parameter("north_m", ranges.north_m),
                 parameter("height_m", ranges.height_m),
                 parameter("heading_deg", ranges.heading_deg),
                 parameter("pitch_deg", ranges.pitch_deg),
                 parameter("roll_deg", ranges.roll_deg)}};
  box.parameters[3].periodic = ranges.heading_deg >= 180.0;
  return box;
}

SampledSearch SampleSearch(const PoseScorer& scorer,
                           const SearchOptions& options,
                           std::uint64_t seed,
                           int threads) {
  const PoseSpace& space = scorer.space();
  SearchProblem problem;
  problem.box = SearchBoxOf(space);
  problem.feasible = [&space](std::span<const double> values) {
    return space.PoseAt(OffsetOf(values)).has_value();
  };
  const auto energy = [&](std::span<const double> values) {
    const std::optional<double> log_ratio = scorer.LogRatioAt(OffsetOf(values));
    return log_ratio ? Score::EnergyOf(*log_ratio) : std::numeric_limits<double>::infinity();
  };
  const std::unique_ptr<Sampler> sampler = MakeSampler(options.sampler, problem, seed);
  MinimizeOptions minimize;
  minimize.budget = options.evaluations;
  minimize.threads = threads;
  SampledSearch search;
  search.trace = Minimize(*sampler, energy, minimize);

  const MapOptions& map = options.map;
  DistinctModesOptions distinct;
  distinct.separation = {map.mode_separation_m,
                         map.mode_separation_m,
                         map.mode_separation_m,
                         map.mode_separation_deg,
                         map.mode_separation_deg,
                         map.mode_separation_deg};
  distinct.max_modes = map.modes;
  for (const Mode& mode : DistinctModes(search.trace, problem.box, distinct)) {
    search.modes.push_back({OffsetOf(mode.values), Score::LogRatioOf(mode.energy)});
  }
  return search;
}

}  // namespace ridgeline
